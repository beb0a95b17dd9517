#include "systems/inner_friction.h"

#include <algorithm>

namespace pleat {

bool InnerFriction::validate() const {
  return garment != nullptr && mass != nullptr && velocity.x != nullptr && force.x != nullptr && deceleration >= 0.0f &&
         dt > 0.0f;
}

void InnerFriction::run() const {
  const std::size_t count = garment->particle_count;
  const bool pinned = garment->pins.size() != 0;
  Vec3 sum;
  float weight = 0.0f;
  if (pinned) {
    for (const std::uint32_t pin : garment->pins) sum = sum + velocity[pin];
    weight = static_cast<float>(garment->pins.size());
  } else {
    for (std::size_t i = 0; i < count; ++i) sum = sum + velocity[i] * mass[i], weight += mass[i];
  }
  const Vec3 carrier = weight > 0.0f ? sum * (1.0f / weight) : Vec3{};

  const float safe_rate = 0.5f / dt;
  Vec3 total;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 v = velocity[i] - carrier;
    const float speed = length(v);
    const float rate = deceleration < safe_rate * speed ? deceleration / speed : safe_rate;
    const Vec3 pull = v * (-rate * mass[i]);
    force.add(i, pull);
    total = total + pull;
  }
  if (pinned || weight <= 0.0f) return;
  const Vec3 back = total * (-1.0f / weight);
  for (std::size_t i = 0; i < count; ++i) force.add(i, back * mass[i]);
}

}  // namespace pleat
