#include "systems/inner_friction.h"

#include <algorithm>

namespace pleat {

bool InnerFriction::validate() const {
  return mass != nullptr && velocity.x != nullptr && force.x != nullptr && deceleration >= 0.0f && dt > 0.0f;
}

void InnerFriction::run() const {
  const float safe_rate = 0.5f / dt;
  for (std::size_t i = 0; i < particle_count; ++i) {
    const Vec3 v = velocity[i];
    const float speed = length(v);
    const float rate = deceleration < safe_rate * speed ? deceleration / speed : safe_rate;
    force.add(i, v * (-rate * mass[i]));
  }
}

}  // namespace pleat
