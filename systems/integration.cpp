#include "systems/integration.h"

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {

bool EulerIntegration::validate() const {
  return inverse_mass != nullptr && force.x != nullptr && position.x != nullptr && velocity.x != nullptr && dt > 0.0f;
}

void EulerIntegration::run() const {
  run_wide(widest_vectors(), [&] {
    for (std::size_t i = 0; i < particle_count; i += kLanes) {
      const Vec3Lanes before = load(ConstVec3View(velocity), i);
      const Vec3Lanes after = before + load(force, i) * load(inverse_mass + i) * dt;
      store(after, velocity, i);
      store(load(ConstVec3View(position), i) + (symplectic ? after : before) * dt, position, i);
    }
  });
}

bool RungeKuttaIntegration::validate() const {
  return inverse_mass != nullptr && force.x != nullptr && start_position.x != nullptr && position.x != nullptr &&
         velocity.x != nullptr && start_velocity.x != nullptr && position_slope.x != nullptr &&
         velocity_slope.x != nullptr && dt > 0.0f && stage >= 0 && stage < 4;
}

void RungeKuttaIntegration::run() const {
  constexpr float kWeight[4] = {1.0f / 6.0f, 2.0f / 6.0f, 2.0f / 6.0f, 1.0f / 6.0f};
  constexpr float kNext[4] = {0.5f, 0.5f, 1.0f, 0.0f};  // how far along its slopes the next stage lies
  for (std::size_t i = 0; i < particle_count; ++i) {
    const Vec3 v = velocity[i], a = force[i] * inverse_mass[i];
    if (stage == 0) {
      start_velocity.set(i, v);
      position_slope.set(i, {});
      velocity_slope.set(i, {});
    }
    position_slope.add(i, v * kWeight[stage]);
    velocity_slope.add(i, a * kWeight[stage]);
    const bool last = stage == 3;
    const float step = last ? dt : kNext[stage] * dt;
    position.set(i, start_position[i] + (last ? position_slope[i] : v) * step);
    velocity.set(i, start_velocity[i] + (last ? velocity_slope[i] : a) * step);
  }
}

}  // namespace pleat
