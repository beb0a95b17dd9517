#include "components/hinge_stiffness.h"

#include <array>
#include <cmath>
#include <vector>

#include "components/zigzag.h"

namespace pleat {
namespace {

using Row = std::array<double, 3>;  // of a symmetric 2 x 2 tensor: xx, yy, sqrt(2) xy
using Vec3d = Vec3T<double>;

constexpr double kStiffest = 3.0;  // times as stiff as the hinge alone; up to 1 on a regular mesh

constexpr float kLeastArea = 1e-12f;  // m2; a smaller face has no curvature

double product(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The turn m of a hinge, for curvature in the frame of one of its two faces.
struct HingeTurn {
  double along, across, mixed;

  /// Edge and tips, from the edge's first end.
  HingeTurn(const Vec3d& e, const Vec3d& a, const Vec3d& b) {
    const double l = length(e), s = dot(a, e) / l, t = dot(b, e) / l;
    const double p = length(cross(e, a)) / l, q = length(cross(e, b)) / l;
    along = (s * (s - l) / p + t * (t - l) / q) / 2;
    across = (p + q) / 2;
    mixed = s - t;
  }

  /// `x`, `y`: the edge's unit direction in the frame.
  Row in_frame(double x, double y) const {
    return {along * x * x + across * y * y - mixed * x * y, along * y * y + across * x * x + mixed * x * y,
            std::sqrt(2.0) * ((along - across) * x * y + 0.5 * mixed * (x * x - y * y))};
  }
};

/// A face and those of its hinges that can bend it.
struct FaceHinges {
  double area;  // m2
  std::array<std::uint32_t, 3> hinge{};
  std::array<bool, 3> has{};
  std::array<Row, 3> turn{};
  Vec3d x{}, y{};                 // axes of its plane
  std::array<double, 3> alone{};  // half of what the hinge has alone, |e|^2 / (A1 + A2)
};

/// A face's share in the stiffness of its hinges; rows and columns of those that it has not are 0.
using Share = std::array<Row, 3>;

/// A (M M^T)^-1, the cosines between turns times `coupling`. False where there is none, or it is too stiff.
bool find_share(const FaceHinges& face, double coupling, Share& share) {
  std::array<double, 3> size{};
  Share g{};
  for (std::size_t i = 0; i < 3; ++i) {
    g[i][i] = 1.0;
    size[i] = face.has[i] ? std::sqrt(product(face.turn[i], face.turn[i])) : 1.0;
    for (std::size_t j = 0; j < i; ++j) {
      const bool both = face.has[i] && face.has[j];
      g[i][j] = g[j][i] = both ? coupling * product(face.turn[i], face.turn[j]) / (size[i] * size[j]) : 0.0;
    }
  }
  const double det =
      1.0 + 2.0 * g[0][1] * g[1][2] * g[0][2] - g[0][1] * g[0][1] - g[1][2] * g[1][2] - g[0][2] * g[0][2];
  if (!(det > 1e-9)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double cofactor = g[j1][i1] * g[j2][i2] - g[j1][i2] * g[j2][i1];
      share[i][j] = face.has[i] && face.has[j] ? face.area * cofactor / (det * size[i] * size[j]) : 0.0;
    }
    if (face.has[i] && share[i][i] > kStiffest * face.alone[i]) return false;
  }
  return true;
}

FaceHinges hinges_of(const Garment& g, std::uint32_t f, const std::vector<std::uint32_t>& hinge_of_edge) {
  const ConstVec3View position = g.rest_position.view();
  const auto at = [&](std::uint32_t i) {
    const Vec3 x = position[i];
    return Vec3d{x.x, x.y, x.z};
  };
  FaceHinges face{.area = static_cast<double>(g.face_rest_area[f])};
  const Vec3d corner = at(g.face_particle[0][f]), side = at(g.face_particle[1][f]) - corner;
  const Vec3d normal = cross(side, at(g.face_particle[2][f]) - corner);
  const Vec3d x = face.x = side * (1.0 / length(side)), y = face.y = cross(normal, x) * (1.0 / length(normal));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t e = g.face_edge[k][f], h = face.hinge[k] = hinge_of_edge[e];
    if (h == kNone) continue;
    const std::uint32_t other = g.edge_face[g.edge_face[0][e] == f ? 1 : 0][e];
    if (g.face_rest_area[other] < kLeastArea) continue;
    face.has[k] = true;
    const Vec3d x0 = at(g.hinge_particle[0][h]), edge = at(g.hinge_particle[1][h]) - x0;
    const HingeTurn turn(edge, at(g.hinge_particle[2][h]) - x0, at(g.hinge_particle[3][h]) - x0);
    face.turn[k] = turn.in_frame(dot(edge, x) / length(edge), dot(edge, y) / length(edge));
    face.alone[k] = 0.5 * dot(edge, edge) / (face.area + static_cast<double>(g.face_rest_area[other]));
  }
  return face;
}

/// In the plane of unit axes x and y.
Tensor in_space(const Row& row, const Vec3d& x, const Vec3d& y) {
  const double root = std::sqrt(2.0), mixed = row[2] / root;
  const Vec3d u = x * row[0] + y * mixed, v = y * row[1] + x * mixed;  // the columns' sum is x u^T + y v^T
  return {x.x * u.x + y.x * v.x,          x.y * u.y + y.y * v.y,          x.z * u.z + y.z * v.z,
          root * (x.y * u.z + y.y * v.z), root * (x.z * u.x + y.z * v.x), root * (x.x * u.y + y.x * v.y)};
}

BentFace bent(const FaceHinges& face) {
  BentFace out{.hinge = face.hinge, .has = face.has};
  for (double coupling = 1.0; !find_share(face, coupling, out.share); coupling *= 0.9) {
  }
  for (std::size_t k = 0; k < 3; ++k) {
    Row moment{};
    for (std::size_t l = 0; l < 3; ++l) {
      for (std::size_t c = 0; c < 3; ++c) moment[c] += out.share[k][l] * face.turn[l][c];
    }
    out.moment[k] = in_space(moment, face.x, face.y);
  }
  return out;
}

}  // namespace

void measure_hinges(Garment& g) {
  g.hinge_shape.resize(g.hinge_count);
  g.hinge_bound.resize(g.hinge_count);
  for (auto& column : g.hinge_beside) column.resize(g.hinge_count);
  for (auto& column : g.hinge_coupling) column.resize(g.hinge_count);
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) {
    for (auto& column : g.hinge_beside) column[h] = h;
  }
  std::vector<std::uint32_t> hinge_of_edge(g.edge_count, kNone);
  for (std::uint32_t e = 0, h = 0; e < g.edge_count; ++e) {
    if (g.edge_face[1][e] != kNone) hinge_of_edge[e] = h++;
  }

  std::vector<BentFace> faces(g.face_count);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    if (g.face_rest_area[f] >= kLeastArea) faces[f] = bent(hinges_of(g, f, hinge_of_edge));
  }
  const std::vector<double> factor = zigzag_factors(g, faces);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const BentFace& face = faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!face.has[k]) continue;
      const std::uint32_t h = face.hinge[k];
      g.hinge_shape[h] += static_cast<float>(factor[f] * face.share[k][k]);
      for (const double c : face.share[k]) g.hinge_bound[h] += static_cast<float>(factor[f] * std::abs(c));
      for (std::size_t l = 1; l < 3; ++l) {
        const std::size_t j = (k + l) % 3, slot = (g.edge_face[0][g.face_edge[k][f]] == f ? 0 : 2) + l - 1;
        if (!face.has[j]) continue;
        g.hinge_beside[slot][h] = face.hinge[j];
        g.hinge_coupling[slot][h] = static_cast<float>(factor[f] * face.share[k][j]);
      }
    }
  }
}

}  // namespace pleat
