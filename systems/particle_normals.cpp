#include "systems/particle_normals.h"

#include <algorithm>

#include "components/base_normal.h"
#include "components/vec3_block.h"

namespace pleat {
namespace {

constexpr float kForceFloor = 0.05f;    // f0 over k times the mean edge length
constexpr float kBaseFallback = 1e-9f;  // the base normal's share in kPaper, below any force but zero

/// The share of a face at its three corners: the sum at each takes it times the cross product of two sides.
template <SurfaceMode mode>
inline std::array<float, 3> face_shares(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& face,
                                        const std::array<float, 3>& rest_length, float mean_length) {
  std::array<float, 3> share = corner_weights(rest_length, mean_length);
  if constexpr (mode == SurfaceMode::kPaper || mode == SurfaceMode::kPleat) {
    const auto strain = [](const Vec3& side, float rest) {
      const float e = length(side) / rest - 1.0f;
      return mode == SurfaceMode::kPaper || e > 0.0f ? e : 0.0f;
    };
    const Vec3 ab = b - a, bc = c - b, ca = a - c;  // eq (1) over k, from each corner towards the next
    const Vec3 fa = ab * strain(ab, rest_length[0]), fb = bc * strain(bc, rest_length[1]),
               fc = ca * strain(ca, rest_length[2]);
    const float scale = 1.0f / mean_length;
    const std::array<float, 3> force{scale * length(fa - fc), scale * length(fb - fa), scale * length(fc - fb)};
    if constexpr (mode == SurfaceMode::kPaper) {
      const float area2 = length(face);
      const float unit = area2 > 1e-12f ? 1.0f / area2 : 0.0f;
      for (std::size_t k = 0; k < 3; ++k) share[k] = kBaseFallback * share[k] + unit * force[k];
    } else {
      for (std::size_t k = 0; k < 3; ++k) share[k] *= 1.0f + force[k] * (1.0f / kForceFloor);
    }
  }
  return share;
}

template <SurfaceMode mode>
void sum_normals(const ParticleNormals& s) {
  const Garment& g = *s.garment;
  clear(s.normal, g.particle_count);
  for (std::uint32_t begin = 0; begin < g.face_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - begin);
    Vec3Block x[3], sum[3];
    float rest_length[3][kLanes];
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t f = begin + std::min(lane, count - 1);
      for (std::size_t k = 0; k < 3; ++k) {
        x[k].set(lane, s.position[g.face_particle[k][f]]);
        rest_length[k][lane] = g.edge_rest_length[g.face_edge[k][f]];
      }
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Vec3 a = x[0][lane], b = x[1][lane], c = x[2][lane], face = cross(b - a, c - a);
      const std::array<float, 3> share = face_shares<mode>(
          a, b, c, face, {rest_length[0][lane], rest_length[1][lane], rest_length[2][lane]}, g.mean_edge_length);
      for (std::size_t k = 0; k < 3; ++k) sum[k].set(lane, face * share[k]);
    }
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      for (std::size_t k = 0; k < 3; ++k) s.normal.add(g.face_particle[k][begin + lane], sum[k][lane]);
    }
  }
  normalize(s.normal, g.particle_count);
}

}  // namespace

bool ParticleNormals::validate() const {
  return mode <= SurfaceMode::kArcPn && garment != nullptr && position.x != nullptr && normal.x != nullptr;
}

void ParticleNormals::run() const {
  switch (mode) {
    case SurfaceMode::kPaper:
      return sum_normals<SurfaceMode::kPaper>(*this);
    case SurfaceMode::kPleat:
      return sum_normals<SurfaceMode::kPleat>(*this);
    default:
      return sum_normals<SurfaceMode::kPn>(*this);
  }
}

}  // namespace pleat
