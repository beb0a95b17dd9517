// Capsules near a cloth, eight side by side: what a capsule is tested against at once.
#pragma once

#include <limits>

#include "components/colliders.h"
#include "components/lanes.h"

namespace pleat {

/// What of eight capsules tells how near they are. Lanes without one have a radius that is near nothing.
struct CapsuleBlock {
  Vec3Lanes a, axis;  // where the core begins at the end of the substep; from a to b, m
  Lanes inverse{};    // 1/m2 of the axis, or zero
  Lanes widest = all(-std::numeric_limits<float>::max());  // radius where it is widest, m

  void put(std::size_t lane, const CapsulePose& c) {
    const Vec3 along = c.b - c.a;
    a.x[lane] = c.a.x, a.y[lane] = c.a.y, a.z[lane] = c.a.z;
    axis.x[lane] = along.x, axis.y[lane] = along.y, axis.z[lane] = along.z;
    const float along2 = dot(along, along);
    inverse[lane] = along2 > 0.0f ? 1.0f / along2 : 0.0f;
    widest[lane] = c.radius + std::max(c.taper, 0.0f);
  }
};

/// Of so many capsules.
constexpr std::size_t capsule_blocks(std::size_t capsules) { return (capsules + kLanes - 1) / kLanes; }

}  // namespace pleat
