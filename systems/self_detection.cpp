#include "systems/self_detection.h"

#include "systems/closeness.h"
#include "systems/contact_row.h"

namespace pleat {

bool SelfDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         pairs.pairs != nullptr && pairs.count != nullptr && friction >= 0.0f && dt > 0.0f && contacts.count != nullptr;
}

void SelfDetection::run(Stats& stats) const {
  const auto& corner = garment->face_particle;
  const auto& end = garment->edge_particle;
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  for (NearPair* pair = pairs.pairs; pair != pairs.pairs + *pairs.count; ++pair) {
    const bool face = pair->kind == NearKind::kParticleFace;
    const std::uint32_t f = pair->first, s = pair->second;
    if (face && garment->particle_area[f] == 0.0f) continue;  // a vertex without a triangle is no part of the cloth
    const std::uint32_t i[4] = {face ? f : end[0][f], face ? corner[0][s] : end[1][f], face ? corner[1][s] : end[0][s],
                                face ? corner[2][s] : end[1][s]};
    const Vec3 x[4] = {position[i[0]], position[i[1]], position[i[2]], position[i[3]]};
    const Vec3 before[4] = {previous[i[0]], previous[i[1]], previous[i[2]], previous[i[3]]};
    Closeness near;
    if (!closeness(pair->kind, x, before, pair->side, near)) continue;
    if (near.distance > 2.0f * pair->distance) continue;
    rows.add({.particle = {i[0], i[1], i[2], i[3]},
              .weight = {near.weight[0], near.weight[1], near.weight[2], near.weight[3]},
              .normal = near.normal,
              .offset = pair->distance,
              .body_step = {},
              .friction = friction,
              .share = {},
              .count = 4,
              .push = 0.0f,
              .rubbed = 0.0f},
             stats);
  }
}

}  // namespace pleat
