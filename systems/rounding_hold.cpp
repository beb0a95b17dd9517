#include "systems/rounding_hold.h"

#include <cmath>

namespace pleat {
namespace {

constexpr float kRounding = 0x1p-22f;  // of a position: 2 ulp, at most
constexpr float kStill = 0x1p-20f;     // likewise, a substep's way: .5 mm/s at 1 m

PLEAT_KERNEL void hold_axis(std::size_t count, float dt, float w2, const float* x0, const float* x, const float* v,
                            float* held) {
  for (std::size_t i = 0; i < count; ++i) {
    const float step = v[i] * dt, lost = (x[i] - x0[i]) - step, size = std::abs(x[i]);
    const bool rounded = std::abs(lost) <= kRounding * size, rests = std::abs(step) <= kStill * size;
    held[i] += rounded && rests ? w2 * lost : 0.0f;
  }
}

}  // namespace

bool RoundingHold::validate() const {
  return previous.x != nullptr && position.x != nullptr && velocity.x != nullptr && dt > 0.0f && friction_dt > 0.0f &&
         held.x != nullptr;
}

void RoundingHold::run(VectorSet set) const {
  const float w = 0.25f / friction_dt, w2 = w * w;
  run_wide(set, [&] {
    hold_axis(particle_count, dt, w2, previous.x, position.x, velocity.x, held.x);
    hold_axis(particle_count, dt, w2, previous.y, position.y, velocity.y, held.y);
    hold_axis(particle_count, dt, w2, previous.z, position.z, velocity.z, held.z);
  });
}

}  // namespace pleat
