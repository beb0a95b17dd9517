#include "systems/tether_constraint.h"

namespace pleat {

bool TetherConstraint::validate() const { return garment != nullptr && position != nullptr && limit >= 0.0f; }

void TetherConstraint::run() const {
  for (std::size_t t = 0; t < garment->tether_length.size(); ++t) {
    const std::uint32_t i = garment->tether_particle[t];
    const Vec3 x = vector_of(position[i]), d = vector_of(position[garment->tether_pin[t]]) - x;
    const float l = length(d), longest = (1.0f + limit) * garment->tether_length[t];
    if (l <= longest) continue;
    const Vec3 end = x + d * (1.0f - longest / l);
    position[i] = {end.x, end.y, end.z, position[i].w};
  }
}

}  // namespace pleat
