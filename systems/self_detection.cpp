#include "systems/self_detection.h"

#include "systems/contact_row.h"

namespace pleat {
namespace {

/// Faces overlap by this share, so that there is no gap between them when the particles of two layers lie on each
/// other.
constexpr float kOverlap = 0.05f;

}  // namespace

bool SelfDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         pairs.pairs != nullptr && pairs.count != nullptr && friction >= 0.0f && dt > 0.0f && contacts.count != nullptr;
}

void SelfDetection::run(Stats& stats) const {
  const auto& corner = garment->face_particle;
  const float margin = contact_margin(position, previous, garment->particle_count);
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  for (SelfPair* pair = pairs.pairs; pair != pairs.pairs + *pairs.count; ++pair) {
    const std::uint32_t p = pair->particle, i = corner[0][pair->face], j = corner[1][pair->face],
                        k = corner[2][pair->face];
    const Vec3 xi = position[i], u = position[j] - xi, v = position[k] - xi, w = position[p] - xi;
    const Vec3 area = cross(u, v);
    const float area2 = dot(area, area);
    if (!(area2 > 1e-16f)) continue;
    const float bj = dot(cross(w, v), area) / area2, bk = dot(cross(u, w), area) / area2, bi = 1.0f - bj - bk;
    if (!(bi > -kOverlap && bj > -kOverlap && bk > -kOverlap)) {
      pair->side = 0.0f;
      continue;
    }
    if (pair->side == 0.0f) {
      const Vec3 before = previous[p] - previous[i] * bi - previous[j] * bj - previous[k] * bk;
      pair->side = dot(before, area) < 0.0f ? -1.0f : 1.0f;
    }
    const Vec3 normal = area * (pair->side / std::sqrt(area2));
    if (dot(w, normal) > pair->distance + margin) continue;
    rows.add({.particle = {p, i, j, k},
              .weight = {1.0f, -bi, -bj, -bk},
              .count = 4,
              .normal = normal,
              .offset = pair->distance,
              .body_step = {},
              .friction = friction,
              .inverse_mass = 0.0f,
              .push = 0.0f},
             stats);
  }
}

}  // namespace pleat
