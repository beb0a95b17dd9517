#include "systems/particle_normals.h"

#include "components/base_normal.h"

namespace pleat {
namespace {

constexpr float kForceFloor = 0.05f;    // f0 over k times the mean edge length
constexpr float kBaseFallback = 1e-9f;  // the base normal's share in kPaper, below any force but zero

/// Forces of eq (4) at the corners of face f over k times the mean edge length.
std::array<float, 3> corner_forces(const Garment& g, std::uint32_t f, ConstVec3View position) {
  Vec3 force[3];  // eq (1), from corner k towards the next
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = position[g.face_particle[(k + 1) % 3][f]] - position[g.face_particle[k][f]];
    force[k] = side * (length(side) / g.edge_rest_length[g.face_edge[k][f]] - 1.0f);
  }
  const float scale = 1.0f / g.mean_edge_length;
  return {scale * length(force[0] - force[2]), scale * length(force[1] - force[0]),
          scale * length(force[2] - force[1])};
}

}  // namespace

bool ParticleNormals::validate() const {
  return mode <= SurfaceMode::kPleat && garment != nullptr && position.x != nullptr && normal.x != nullptr;
}

void ParticleNormals::run() const {
  const Garment& g = *garment;
  clear(normal, g.particle_count);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const Vec3 face = face_cross(g, f, position);
    std::array<float, 3> weight = corner_weights(g, f);
    if (mode == SurfaceMode::kPaper) {
      const std::array<float, 3> force = corner_forces(g, f, position);
      const float area2 = length(face);
      const float unit = area2 > 1e-12f ? 1.0f / area2 : 0.0f;
      for (std::size_t k = 0; k < 3; ++k) weight[k] = kBaseFallback * weight[k] + unit * force[k];
    } else if (mode == SurfaceMode::kPleat) {
      const std::array<float, 3> force = corner_forces(g, f, position);
      for (std::size_t k = 0; k < 3; ++k) weight[k] *= 1.0f + force[k] * (1.0f / kForceFloor);
    }
    for (std::size_t k = 0; k < 3; ++k) normal.add(g.face_particle[k][f], face * weight[k]);
  }
  normalize(normal, g.particle_count);
}

}  // namespace pleat
