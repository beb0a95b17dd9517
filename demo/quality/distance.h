#pragma once

#include <Eigen/Core>

namespace pleat::demo {

using Eigen::Vector3d;

/// All points within `radius` of the segment ab; a = b is a sphere. A tapered one is the hull of its end balls. Metres,
/// world space.
struct ExactCapsule {
  Vector3d a, b;
  double radius;
  double taper = 0.0;  ///< what the ball about b has more
};

struct Triangle {
  Vector3d a, b, c;
};

/// The point of the segment ab that is nearest to p.
Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b);

/// The point of a triangle (corners, edges and interior) that is nearest to p.
Vector3d nearest_on_triangle(const Vector3d& p, const Triangle& triangle);

/// Distance from p to the capsule's surface, m; negative inside.
double signed_distance(const Vector3d& p, const ExactCapsule& capsule);

/// The least signed distance of any point of the triangle to the capsule, m; exact. A triangle that the core of a
/// capsule pierces is at -radius.
double signed_distance(const Triangle& triangle, const ExactCapsule& capsule);

}  // namespace pleat::demo
