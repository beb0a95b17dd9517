#include "systems/pin_jump.h"

#include "systems/rigid_fit.h"

namespace pleat {
namespace {

constexpr float kMostTurnHalfCosine = 0.2588f;  // cos(150 degrees / 2)

}  // namespace

Vec3 mean_motion(ConstVec3View previous, ConstVec3View next, std::size_t count) {
  return mean_of(next, count) - mean_of(previous, count);
}

bool PinJump::validate() const { return count > 0 && previous.x != nullptr && next.x != nullptr && speed > 0.0f; }

std::optional<RigidMotion> PinJump::run() const {
  const Vec3 from = mean_of(previous, count), to = mean_of(next, count);
  const bool far = length(velocity) > speed && length(velocity - velocity_before) > speed;

  float spread = 0.0f, moved = 0.0f;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 arm = previous[k] - from, motion = next[k] - to - arm;
    spread += dot(arm, arm);
    moved += dot(motion, motion);
  }
  // By 150 degrees an arm's end moves by 1.9 of its length; only arms along the axis do not move.
  const bool may_have_turned = moved > 0.1f * spread;
  if (!far && !may_have_turned) return std::nullopt;
  const RigidMotion motion = best_motion(previous, next, count);
  if (!far && motion.rotation.w > kMostTurnHalfCosine) return std::nullopt;
  return motion;
}

}  // namespace pleat
