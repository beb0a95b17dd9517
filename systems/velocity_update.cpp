#include "systems/velocity_update.h"

namespace pleat {

bool VelocityUpdate::validate() const {
  return position.x != nullptr && predicted.x != nullptr && inverse_mass != nullptr && velocity.x != nullptr &&
         dt > 0.0f;
}

void VelocityUpdate::run() const {
  const float rate = 1.0f / dt;
  for (std::size_t i = 0; i < particle_count; ++i) {
    if (inverse_mass[i] != 0.0f) velocity.add(i, (position[i] - predicted[i]) * rate);
  }
}

}  // namespace pleat
