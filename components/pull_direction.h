// Along which two particles are pulled together or pushed apart.
//   J.-P. Ryckaert, G. Ciccotti, H. Berendsen, "Numerical Integration of the Cartesian Equations of Motion of a System
//   with Constraints", 1977 (SHAKE): along the way between them where the step begins, and swings keep their energy.
#pragma once

#include <algorithm>

#include "components/lanes.h"

namespace pleat {

struct Pull {
  Four way;     // a multiple of the direction, m
  float along;  // its product with the way between the two, m2
};

/// `now`: the way from one to the other, and now2 = now . now; `before`: where the step began, carrying its own square.
/// A pull along the way where the step ends lags behind it by its turn in the step and brakes every swing: a pendulum
/// of angular speed W by 3/8 W^2 dt, 1/s, and cloth under tension by more. Where the way has turned by more than 30
/// degrees, or become longer or shorter by a seventh, it is `now`.
inline Pull pull_direction(const Four& now, float now2, const Four& before) {
  constexpr float kCosine = 0.87f;
  const float along = dot(now, before);
  if (along > kCosine * std::max(now2, before[3])) return {without_load(before), along};
  return {now, now2};
}

}  // namespace pleat
