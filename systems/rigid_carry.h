// Carries a cloth rigidly to another place, as if the world had moved around it.
#pragma once

#include <cstddef>

#include "components/column.h"
#include "components/rigid_pose.h"

namespace pleat {

/// x := motion(x), and vectors turn with it, so that afterwards the cloth looks and moves as before, seen from its
/// pins.
/// Reads:  motion
/// Writes: position (P) m; velocity (P) m/s; held (P) m/s2 where there is any
/// Cost:   O(P), no allocation. Errors: none.
struct RigidCarry {
  RigidMotion motion;
  std::size_t particle_count = 0;
  Vec3View position, velocity;
  Vec3View held = {};  // may be null

  bool validate() const;
  void run() const;
};

}  // namespace pleat
