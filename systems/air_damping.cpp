#include "systems/air_damping.h"

#include <algorithm>

namespace pleat {

bool AirDamping::validate() const {
  return mass != nullptr && velocity.x != nullptr && force.x != nullptr && rate >= 0.0f && dt > 0.0f;
}

void AirDamping::run() const {
  const float safe_rate = std::min(rate, 0.5f / dt);
  for (std::size_t i = 0; i < particle_count; ++i) force.add(i, velocity[i] * (-safe_rate * mass[i]));
}

}  // namespace pleat
