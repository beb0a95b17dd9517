// Exact distances between points, segments, triangles and capsules, in double precision.
//
// Nearest point of a triangle by Voronoi regions, nearest points of two segments by clamped minimisation:
// C. Ericson, Real-Time Collision Detection, 2005, sections 5.1.5 and 5.1.9.
#include "demo/quality/distance.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace pleat::demo {
namespace {

double segment_segment_distance(const Vector3d& p1, const Vector3d& q1, const Vector3d& p2, const Vector3d& q2) {
  const Vector3d d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = d1.squaredNorm(), e = d2.squaredNorm();
  if (a == 0.0) return (p1 - nearest_on_segment(p1, p2, q2)).norm();
  if (e == 0.0) return (p2 - nearest_on_segment(p2, p1, q1)).norm();
  const double b = d1.dot(d2), c = d1.dot(r), f = d2.dot(r);
  const double denominator = a * e - b * b;  // 0 for parallel segments: any s is as good
  double s = denominator > 0.0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  const double t = std::clamp((b * s + f) / e, 0.0, 1.0);
  s = std::clamp((b * t - c) / a, 0.0, 1.0);
  return (p1 + s * d1 - p2 - t * d2).norm();
}

bool segment_pierces(const Vector3d& p, const Vector3d& q, const Triangle& t) {
  const Vector3d normal = (t.b - t.a).cross(t.c - t.a);
  const double side_p = normal.dot(p - t.a), side_q = normal.dot(q - t.a);
  if (side_p * side_q > 0.0 || side_p == side_q) return false;
  const Vector3d x = p + (q - p) * (side_p / (side_p - side_q));
  return normal.dot((t.b - t.a).cross(x - t.a)) >= 0.0 && normal.dot((t.c - t.b).cross(x - t.b)) >= 0.0 &&
         normal.dot((t.a - t.c).cross(x - t.c)) >= 0.0;
}

/// Of a tapered capsule: the least over its balls of what `core_distance` says of a ball's center, less the ball's
/// radius. Both are convex along the core.
template <class CoreDistance>
double least_over_balls(const ExactCapsule& capsule, const CoreDistance& core_distance) {
  const auto distance = [&](double t) {
    return core_distance(capsule.a + t * (capsule.b - capsule.a)) - capsule.radius - capsule.taper * t;
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double s = (2.0 * low + high) / 3.0, t = (low + 2.0 * high) / 3.0;
    if (distance(s) < distance(t)) {
      high = t;
    } else {
      low = s;
    }
  }
  return std::min({distance(0.0), distance(0.5 * (low + high)), distance(1.0)});
}

}  // namespace

Vector3d nearest_on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d d = b - a;
  const double length2 = d.squaredNorm();
  if (length2 == 0.0) return a;
  return a + d * std::clamp(d.dot(p - a) / length2, 0.0, 1.0);
}

Vector3d nearest_on_triangle(const Vector3d& p, const Triangle& t) {
  const Vector3d ab = t.b - t.a, ac = t.c - t.a;
  const Vector3d ap = p - t.a, bp = p - t.b, cp = p - t.c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return t.a;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return t.b;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return t.c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return nearest_on_segment(p, t.a, t.b);
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return nearest_on_segment(p, t.a, t.c);
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return nearest_on_segment(p, t.b, t.c);
  const double scale = 1.0 / (va + vb + vc);
  return t.a + ab * (vb * scale) + ac * (vc * scale);
}

double signed_distance(const Vector3d& p, const ExactCapsule& capsule) {
  if (capsule.taper != 0.0) return least_over_balls(capsule, [&](const Vector3d& ball) { return (p - ball).norm(); });
  return (p - nearest_on_segment(p, capsule.a, capsule.b)).norm() - capsule.radius;
}

double signed_distance(const Triangle& t, const ExactCapsule& capsule) {
  if (capsule.taper != 0.0) {
    return least_over_balls(capsule,
                            [&](const Vector3d& ball) { return (ball - nearest_on_triangle(ball, t)).norm(); });
  }
  const Vector3d &a = capsule.a, &b = capsule.b;
  if (segment_pierces(a, b, t)) return -capsule.radius;
  const double core = std::min({(a - nearest_on_triangle(a, t)).norm(), (b - nearest_on_triangle(b, t)).norm(),
                                segment_segment_distance(a, b, t.a, t.b), segment_segment_distance(a, b, t.b, t.c),
                                segment_segment_distance(a, b, t.c, t.a)});
  return core - capsule.radius;
}

}  // namespace pleat::demo
