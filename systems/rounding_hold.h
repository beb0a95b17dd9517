// What rounding does to cloth at rest.
#pragma once

#include "components/column.h"
#include "components/wide.h"

namespace pleat {

/// A step shorter than the last digit of a position is lost, and others are rounded: cloth that inner friction holds by
/// its velocity alone wanders off, .1 mm in five hours. Here the friction's spring learns where the particle really is:
///   s += w^2 (x - x0 - v dt),  w as of InnerFriction,  along each axis where that is of the size of rounding, 2 ulp of
///   x
/// x0 where the substep began. What else has parted position and velocity, contact or a guard, is larger and stays out;
/// so does what moves by more than 8 ulp a substep, for which rounding is nothing.
/// Reads:  position, previous (P) m; velocity (P) m/s
/// Writes: held (P) m/s2, InnerFriction's s
/// Cost:   O(P), no allocation. Errors: none.
struct RoundingHold {
  std::size_t particle_count = 0;
  ConstVec3View previous, position, velocity;
  float dt = 0.0f;           // s, of the substep
  float friction_dt = 0.0f;  // s, dt of InnerFriction
  Vec3View held;

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
