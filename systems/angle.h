// The angle of a direction in the plane, without the library's atan2: the same bits on every platform, no table, no
// branch that a vector unit could not take.
#pragma once

#include <numbers>

#include "components/lanes.h"

namespace pleat {

/// atan2(y, x) within 4e-7 rad; 0 for the zero vector. The polynomial is the minimax odd one of degree 13 for atan on
/// [0, 1], fitted for this file by iteratively reweighted least squares.
inline Lanes angle_of(const Lanes& y, const Lanes& x) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const Lanes ax = abs(x), ay = abs(y);
  const Lanes longer = max(ax, ay);
  const Lanes t = min(ax, ay) / (longer > 0.0f ? longer : all(1.0f));
  const Lanes u = t * t;
  Lanes angle = all(0.00681179296f);
  angle = angle * u - 0.0336042196f;
  angle = angle * u + 0.0796236694f;
  angle = angle * u - 0.132333428f;
  angle = angle * u + 0.198078156f;
  angle = angle * u - 0.333173692f;
  angle = (angle * u + 0.999996126f) * t;
  angle = ay > ax ? 0.5f * kPi - angle : angle;
  angle = x < 0.0f ? kPi - angle : angle;
  return y < 0.0f ? -angle : angle;
}

}  // namespace pleat
