// The air's velocity at a moment: wind that comes in gusts.
#pragma once

#include <cstdint>

#include "components/vec3.h"

namespace pleat {

/// Writes wind + strength n(time), where each axis of n is smooth noise of unit root mean square: a cubic B-spline over
/// random values, 2 * frequency of them a second. It is a function of time alone, so it does not depend on the steps in
/// which time passes; it has continuous acceleration and is never above 2.51. Its spectrum is sinc^4: 1/6 of its
/// amplitude is left at `frequency`, nothing at twice that.
/// Reads:  nothing else.  Writes: air m/s.  Cost: O(1).  Errors: none.
struct Gust {
  Vec3 wind;               // m/s, mean
  float strength = 0.0f;   // m/s
  float frequency = 0.0f;  // Hz
  std::uint32_t seed = 0;
  double time = 0.0;  // s
  Vec3* air = nullptr;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
