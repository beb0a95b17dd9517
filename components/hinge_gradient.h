// How the angle of a hinge changes when its particles move.
//   R. Bridson, S. Marino, R. Fedkiw, "Simulation of Clothing with Folds and Wrinkles", 2003: the same four directions.
#pragma once

#include "components/lanes.h"

namespace pleat {

/// Of a hinge whose faces (x0, x1, x2) and (x1, x0, x3) meet at the edge from x0 to x1. T: float, or lanes of as many
/// hinges. Where a face has no area or the edge no length, has_extent is false and the gradient means nothing, though
/// it is finite.
template <class T>
struct HingeGradient {
  Vec3T<T> na, nb;                 // m2, cross products of both faces, to the same side
  T length;                        // m, of the edge
  decltype(T{} < T{}) has_extent;  // bool, or a mask
  Vec3T<T> at[4];                  // 1/m, of the angle, by the place of each particle

  PLEAT_KERNEL HingeGradient(const Vec3T<T>& x0, const Vec3T<T>& x1, const Vec3T<T>& x2, const Vec3T<T>& x3) {
    const Vec3T<T> e = x1 - x0;
    na = cross(e, x2 - x0), nb = cross(x3 - x0, e);
    const T na2 = dot(na, na), nb2 = dot(nb, nb), one = T{} + 1.0f;
    length = sqrt(dot(e, e));
    has_extent = (min(na2, nb2) >= 4e-24f) & (length >= 1e-9f);

    const Vec3T<T> u = e * (1.0f / (has_extent ? length : one));
    const Vec3T<T> a = na * (1.0f / (has_extent ? na2 : one)), b = nb * (1.0f / (has_extent ? nb2 : one));
    at[0] = -(a * dot(x2 - x1, u) + b * dot(x3 - x1, u));
    at[1] = a * dot(x2 - x0, u) + b * dot(x3 - x0, u);
    at[2] = a * -length, at[3] = b * -length;
  }
};

}  // namespace pleat
