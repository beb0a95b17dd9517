#include "systems/inner_friction.h"

#include <algorithm>

#include "components/vec3_block.h"

namespace pleat {
namespace {

constexpr float kStickSpeed = 1e-3f;  // m/s

/// What all particles have in common.
struct Law {
  Vec3 carrier;              // m/s
  float deceleration, fast;  // m/s2, m/s
  float stiffness, damping;  // of the spring by velocity and step: w^2 dt, 1/s; 2 w, 1/s
};

/// Some particles side by side.
struct Block {
  Vec3Block velocity, held, pull;
  float mass[kLanes];
};

PLEAT_KERNEL Vec3 shortened(const Vec3& v, float longest) {
  const float l = length(v);
  return v * (l > longest ? longest / l : 1.0f);
}

PLEAT_KERNEL void hold(Block& block, const Law& law) {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const Vec3 relative = block.velocity[lane] - law.carrier, v = shortened(relative, law.fast);
    const float slip2 = dot(relative, relative) * (1.0f / (kStickSpeed * kStickSpeed));
    const float most = law.deceleration * (1.0f + 1.0f / (1.0f + slip2));
    const Vec3 spring = shortened(block.held[lane] + v * law.stiffness, most);
    block.held.set(lane, spring);
    block.pull.set(lane, shortened(spring + v * law.damping, most) * -block.mass[lane]);
  }
}

/// Reads into the columns' padding, which has no mass, but leaves it alone. Returns the sum of what pulls.
PLEAT_KERNEL Vec3 hold_all(const InnerFriction& in, const Law& law) {
  Vec3Block sum{};
  for (std::uint32_t begin = 0; begin < in.garment->particle_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, in.garment->particle_count - begin);
    Block block;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      block.velocity.set(lane, in.velocity[begin + lane]);
      block.held.set(lane, in.held[begin + lane]);
      block.mass[lane] = in.mass[begin + lane];
    }
    hold(block, law);
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      in.held.set(begin + lane, block.held[lane]);
      in.force.add(begin + lane, block.pull[lane]);
      sum.set(lane, sum[lane] + block.pull[lane]);
    }
  }
  Vec3 total;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) total += sum[lane];
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
