#include "systems/rigid_carry.h"

namespace pleat {

bool RigidCarry::validate() const { return position.x != nullptr && velocity.x != nullptr; }

void RigidCarry::run() const {
  for (std::size_t i = 0; i < particle_count; ++i) {
    position.set(i, motion.apply(position[i]));
    velocity.set(i, rotate(motion.rotation, velocity[i]));
    if (held.x != nullptr) held.set(i, rotate(motion.rotation, held[i]));
  }
}

}  // namespace pleat
