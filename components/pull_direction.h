// Along which two particles are pulled together or pushed apart.
//   J.-P. Ryckaert, G. Ciccotti, H. Berendsen, "Numerical Integration of the Cartesian Equations of Motion of a System
//   with Constraints", 1977 (SHAKE): along the way between them where the step begins, and swings keep their energy.
#pragma once

#include "components/lanes.h"

namespace pleat {

/// T: float, or Lanes.
template <class T>
struct Pull {
  Vec3T<T> way;  // a multiple of the direction, m
  T along;       // its product with the way between the two, m2
};

/// `now`: the way from one to the other, and now2 = now . now; `before`: where the step began.
/// A pull along the way where the step ends lags behind it by its turn in the step and brakes every swing: a pendulum
/// of angular speed W by 3/8 W^2 dt, 1/s, and cloth under tension by more. Where the way has turned by more than 30
/// degrees, or become longer or shorter by a seventh, it is `now`.
template <class T>
Pull<T> pull_direction(const Vec3T<T>& now, const T& now2, const Vec3T<T>& before) {
  constexpr float kCosine = 0.87f;
  const T along = dot(now, before);
  const auto lasts = along > kCosine * max(now2, dot(before, before));
  return {choose(lasts, before, now), lasts ? along : now2};
}

}  // namespace pleat
