#include "systems/contact_acceleration.h"

#include <algorithm>

namespace pleat {
namespace {

constexpr float kTouchingGap = 1e-4f;   // m
constexpr float kLeavingSpeed = 1e-3f;  // m/s

}  // namespace

bool ContactAcceleration::validate() const {
  return contacts.count != nullptr && (contacts.rows != nullptr || contacts.capacity == 0) && position.x != nullptr &&
         velocity.x != nullptr && inverse_mass != nullptr && dt > 0.0f && row_dt > 0.0f && force.x != nullptr;
}

void ContactAcceleration::run() const {
  for (std::uint32_t c = 0; c < *contacts.count; ++c) {
    const ContactRow& row = contacts.rows[c];
    const std::uint32_t i = row.particle[0];
    if (!row.at_particle() || inverse_mass[i] == 0.0f) continue;
    if (dot(row.normal, position[i]) - row.offset > kTouchingGap) continue;
    const Vec3 relative = velocity[i] - row.body_step * (1.0f / row_dt);
    const float pressing = -dot(row.normal, force[i]);
    if (pressing <= 0.0f || dot(row.normal, relative) > kLeavingSpeed) continue;

    const Vec3 along = force[i] + row.normal * pressing;
    const Vec3 would_be = relative + along * (inverse_mass[i] * dt);
    const Vec3 sliding = would_be - row.normal * dot(row.normal, would_be);
    const float speed = length(sliding);
    const float holding = speed / (inverse_mass[i] * dt);  // N, what stops it within the step
    const float taken = speed > 1e-12f ? std::min(holding, row.friction * pressing) / speed : 0.0f;
    force.set(i, along - sliding * taken);
  }
}

}  // namespace pleat
