// The rotation that brings one set of points nearest to another.
//   B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions", 1987.
#pragma once

#include "components/column.h"
#include "components/rigid_pose.h"

namespace pleat {

/// Sums over pairs of points a, b, each about the mean of its own set.
struct PointPairs {
  double products[3][3] = {};  ///< a_i b_j, m2
  double spread = 0.0;         ///< |a| |b| or more, m2

  void add(const Vec3& a, const Vec3& b);
};

/// Minimises the sum of |b - R a|^2. Where points on a line, or a single one, leave the rotation open it is the
/// smallest of those that fit and, among half turns, the one about the upright axis.
Quaternion best_rotation(const PointPairs& pairs);

/// The mean, summed in double: pins may be far from the origin.
Vec3 mean_of(const ConstVec3View& points, std::size_t count);
/// The rigid motion that brings `from` nearest to `to`, (count) m, count > 0.
RigidMotion best_motion(const ConstVec3View& from, const ConstVec3View& to, std::size_t count);

}  // namespace pleat
