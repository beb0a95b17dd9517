#include "systems/tether_constraint.h"

namespace pleat {

bool TetherConstraint::validate() const { return garment != nullptr && position.x != nullptr && limit >= 0.0f; }

void TetherConstraint::run() const {
  for (std::size_t t = 0; t < garment->tether_length.size(); ++t) {
    const std::uint32_t i = garment->tether_particle[t];
    const Vec3 d = position[garment->tether_pin[t]] - position[i];
    const float l = length(d), longest = (1.0f + limit) * garment->tether_length[t];
    if (l > longest) position.add(i, d * (1.0f - longest / l));
  }
}

}  // namespace pleat
