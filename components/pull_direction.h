// Along which two particles are pulled together or pushed apart.
//   J.-P. Ryckaert, G. Ciccotti, H. Berendsen, "Numerical Integration of the Cartesian Equations of Motion of a System
//   with Constraints", 1977 (SHAKE): along the way between them where the step begins, and swings keep their energy.
#pragma once

#include <algorithm>

#include "components/lanes.h"

namespace pleat {

/// A multiple of the direction. `now`: the way from one to the other; `before`: the same where the step began.
/// A pull along the way where the step ends lags behind it by its turn in the step and brakes every swing: a pendulum
/// of angular speed W by 3/8 W^2 dt, 1/s, and cloth under tension by more. Where the way has turned by more than 30
/// degrees, or become longer or shorter by a seventh, it is `now`.
inline Four pull_direction(const Four& now, const Four& before) {
  constexpr float kCosine = 0.87f;
  return dot(now, before) > kCosine * std::max(dot(now, now), dot(before, before)) ? before : now;
}

}  // namespace pleat
