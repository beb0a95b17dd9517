#include "systems/inner_friction.h"

#include <algorithm>

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {
namespace {

constexpr float kStickSpeed = 1e-3f;  // m/s

/// What all particles have in common.
struct Law {
  Vec3 carrier;              // m/s
  float deceleration, fast;  // m/s2, m/s
  float stiffness, damping;  // of the spring by velocity and step: w^2 dt, 1/s; 2 w, 1/s
};

PLEAT_KERNEL Vec3Lanes shortened(const Vec3Lanes& v, const Lanes& longest) {
  const Lanes l = length(v);
  return v * (l > longest ? longest / l : all(1.0f));
}

/// Reads into the columns' padding, which has no mass, but leaves it alone. Returns the sum of what pulls.
PLEAT_KERNEL Vec3 hold_all(const InnerFriction& in, const Law& law) {
  const std::uint32_t particles = in.garment->particle_count;
  Vec3Lanes sum{};
  for (std::uint32_t i = 0; i < particles; i += kLanes) {
    const std::uint32_t count = std::min(kLanes, particles - i);
    const Vec3Lanes relative = load(in.velocity, i) - all(law.carrier), v = shortened(relative, all(law.fast));
    const Lanes slip2 = dot(relative, relative) * (1.0f / (kStickSpeed * kStickSpeed));
    const Lanes most = law.deceleration * (1.0f + 1.0f / (1.0f + slip2));
    const Vec3Lanes held = shortened(load(ConstVec3View(in.held), i) + v * law.stiffness, most);
    const Vec3Lanes pull = shortened(held + v * law.damping, most) * -load(in.mass + i);
    store(held, in.held, i, count);
    store(load(ConstVec3View(in.force), i) + pull, in.force, i, count);
    sum += choose(first_lanes(count), pull, Vec3Lanes{});
  }
  Vec3 total;
  for (std::uint32_t k = 0; k < kLanes; ++k) total += Vec3{sum.x[k], sum.y[k], sum.z[k]};
  return total;
}

}  // namespace

bool InnerFriction::validate() const {
  return garment != nullptr && mass != nullptr && velocity.x != nullptr && deceleration >= 0.0f && dt > 0.0f &&
         elapsed > 0.0f && elapsed <= dt && held.x != nullptr && force.x != nullptr;
}

void InnerFriction::run(VectorSet set) const {
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
  const Law law{.carrier = carrier,
                .deceleration = deceleration,
                .fast = 4.0f * deceleration / (w * w * elapsed),  // turns any spring around in one call
                .stiffness = w * w * elapsed,
                .damping = 2.0f * w};
  Vec3 total;
  run_wide(set, [&] { total = hold_all(*this, law); });
  if (pinned || weight <= 0.0f) return;
  const Vec3 back = total * (-1.0f / weight);
  for (std::size_t i = 0; i < count; ++i) force.add(i, back * mass[i]);
}

}  // namespace pleat
