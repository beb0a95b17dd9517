#include "systems/inner_friction.h"

namespace pleat {
namespace {

constexpr float kStickSpeed = 1e-3f;  // m/s

Vec3 shortened(const Vec3& v, float longest) {
  const float l = length(v);
  return l > longest ? v * (longest / l) : v;
}

}  // namespace

bool InnerFriction::validate() const {
  return garment != nullptr && mass != nullptr && velocity.x != nullptr && deceleration >= 0.0f && dt > 0.0f &&
         elapsed > 0.0f && elapsed <= dt && held.x != nullptr && force.x != nullptr;
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

  const float w = 0.25f / dt;
  const float fast = 4.0f * deceleration / (w * w * elapsed);  // turns any spring around in one call
  Vec3 total;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 relative = velocity[i] - carrier, v = shortened(relative, fast);
    const float slip2 = dot(relative, relative) * (1.0f / (kStickSpeed * kStickSpeed));
    const float most = deceleration * (1.0f + 1.0f / (1.0f + slip2));
    const Vec3 spring = shortened(held[i] + v * (w * w * elapsed), most);
    held.set(i, spring);
    const Vec3 pull = shortened(spring + v * (2.0f * w), most) * -mass[i];
    force.add(i, pull);
    total = total + pull;
  }
  if (pinned || weight <= 0.0f) return;
  const Vec3 back = total * (-1.0f / weight);
  for (std::size_t i = 0; i < count; ++i) force.add(i, back * mass[i]);
}

}  // namespace pleat
