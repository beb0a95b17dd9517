#include "components/zigzag.h"

#include <algorithm>
#include <cmath>

namespace pleat {
namespace {

using Vec3d = Vec3T<double>;

constexpr float kSmooth = 0.5f;        // rad; across a sharper rest angle curvature is not one
constexpr double kMostLost = 0.5;      // of a plate's energy
constexpr int kBorder = 4;             // rings of particles next to a border that do not tell by themselves
constexpr double kLeastCurving = 1.0;  // D / N times an area, below which R is no zigzag but noise; there 64

/// Mean of (a . n n^T)(b . n n^T) over all n of the plane in which both lie.
double mean_product(const Tensor& a, const Tensor& b) {
  double product = 0.0;
  for (std::size_t k = 0; k < 6; ++k) product += a[k] * b[k];
  return (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2]) / 8 + product / 4;
}

void add(Tensor& a, const Tensor& b, double times) {
  for (std::size_t k = 0; k < 6; ++k) a[k] += times * b[k];
}

/// How a hinge turns when its particles move along the normal, rad/m.
std::array<double, 4> turn_by_height(const Garment& g, std::uint32_t h) {
  const ConstVec3View position = g.rest_position.view();
  const auto at = [&](std::size_t k) {
    const Vec3 x = position[g.hinge_particle[k][h]];
    return Vec3d{x.x, x.y, x.z};
  };
  const Vec3d e = at(1) - at(0), a = at(2) - at(0), b = at(3) - at(0);
  const double l2 = dot(e, e), l = std::sqrt(l2), s = dot(a, e) / l2, t = dot(b, e) / l2;
  const double p = l / length(cross(e, a)), q = l / length(cross(e, b));
  return {-(1 - s) * p - (1 - t) * q, -s * p - t * q, p, q};
}

/// N, D and area of some faces.
struct Loss {
  double force = 0.0, curving = 0.0, area = 0.0;

  Loss& operator+=(const Loss& b) {
    force += b.force, curving += b.curving, area += b.area;
    return *this;
  }
  /// Of a plate's energy, area / 2.
  double part() const {
    const double d = std::max(curving, kLeastCurving * force / area);
    return d > 0.0 ? std::min(force * force / (d * area), kMostLost) : 0.0;
  }
};

/// Particles whose forces are the mesh's own: no border near that bends less.
std::vector<bool> inner_particles(const Garment& g, std::span<const BentFace> faces) {
  std::vector<bool> inner(g.particle_count, true);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      whole = whole && faces[f].has[k] && std::abs(g.hinge_rest_angle[faces[f].hinge[k]]) < kSmooth;
    }
    if (whole) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      inner[g.face_particle[k][f]] = false;
      if (!faces[f].has[k]) continue;
      for (const auto& column : g.hinge_particle) inner[column[faces[f].hinge[k]]] = false;
    }
  }
  return inner;
}

/// Around each particle, of those faces of which all is known.
std::vector<Loss> find_losses(const Garment& g, std::span<const BentFace> faces) {
  const std::vector<bool> inner = inner_particles(g, faces);
  std::vector<std::array<double, 4>> slope(g.hinge_count);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) slope[h] = turn_by_height(g, h);
  std::vector<Tensor> force(g.particle_count), bent(g.hinge_count);
  for (const BentFace& face : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 4 && face.has[k]; ++i) {
        const std::uint32_t particle = g.hinge_particle[i][face.hinge[k]];
        if (inner[particle]) add(force[particle], face.moment[k], slope[face.hinge[k]][i]);
      }
    }
  }
  std::vector<bool> known(g.hinge_count, true);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t particle = g.hinge_particle[i][h];
      known[h] = known[h] && inner[particle];
      if (inner[particle]) add(bent[h], force[particle], slope[h][i]);
    }
  }

  std::vector<Loss> around(g.particle_count);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const BentFace& face = faces[f];
    Loss loss{.area = static_cast<double>(g.face_rest_area[f])};
    bool all = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = g.face_particle[k][f];
      all = all && face.has[k] && known[face.hinge[k]];
      loss.force += mean_product(force[i], force[i]) / (g.around_begin[i + 1] - g.around_begin[i]);
      for (std::size_t l = 0; l < 3 && all; ++l) {
        if (face.has[l]) loss.curving += face.share[k][l] * mean_product(bent[face.hinge[k]], bent[face.hinge[l]]);
      }
    }
    if (!all) continue;
    for (const auto& corner : g.face_particle) around[corner[f]] += loss;
  }
  return around;
}

/// Particles near a border take what is known around them.
void spread(const Garment& g, std::vector<Loss>& around) {
  for (int ring = 0; ring < kBorder; ++ring) {
    const std::vector<Loss> before = around;
    for (std::uint32_t f = 0; f < g.face_count; ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = g.face_particle[k][f];
        if (before[i].area != 0.0) continue;
        for (std::size_t l = 1; l < 3; ++l) around[i] += before[g.face_particle[(k + l) % 3][f]];
      }
    }
  }
}

}  // namespace

std::vector<double> zigzag_factors(const Garment& g, std::span<const BentFace> faces) {
  std::vector<Loss> around = find_losses(g, faces);
  spread(g, around);
  std::vector<double> factors(g.face_count, 1.0);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    Loss loss;
    for (const auto& corner : g.face_particle) loss += around[corner[f]];
    if (loss.area > 0.0) factors[f] = 1.0 / (1.0 - loss.part());
  }
  return factors;
}

}  // namespace pleat
