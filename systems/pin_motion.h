// Carries pinned particles along the host's poses.
#pragma once

#include "components/garment.h"

namespace pleat {

/// At the start of a substep puts each pin where it is at the fraction t0 of the tick and gives it the velocity that
/// brings it to where it is at t1: a straight line from its previous to its next pose.
/// Reads:  garment pins; pin_previous, pin_next (pins) m, in the host's order
/// Writes: position m, velocity m/s of the pinned particles
/// Cost:   O(pins), no allocation. Errors: none.
struct PinMotion {
  const Garment* garment = nullptr;
  ConstVec3View pin_previous, pin_next;
  float t0 = 0.0f, t1 = 1.0f;
  float dt = 0.0f;  // s, of the substep
  Vec3View position, velocity;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
