// Where two simple shapes come closest, in closed form. Every function is total: segments and triangles of zero size,
// parallel, touching and crossing ones have a finite answer. Sums are formed in double, because the differences that
// decide nearly parallel and nearly flat cases cancel in float.
// Source: C. Ericson, Real-Time Collision Detection (2005), chapter 5.
#pragma once

#include <algorithm>

#include "components/vec3.h"

namespace pleat {

/// t in [0, 1] such that lerp(a, b, t) is the point of segment ab closest to p; 0 where the segment has no length.
inline float closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const float length2 = dot(ab, ab);
  return length2 > 0.0f ? std::clamp(dot(p - a, ab) / length2, 0.0f, 1.0f) : 0.0f;
}

/// lerp(p0, p1, s) and lerp(q0, q1, t) are closest to each other; s, t in [0, 1].
struct SegmentPair {
  float s, t;
};
SegmentPair closest_between_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1);

/// Barycentrics, sum 1, each >= 0. One that is exactly 0 tells that the point lies on the edge opposite that corner.
struct Barycentrics {
  float a, b, c;

  Vec3 point(const Vec3& pa, const Vec3& pb, const Vec3& pc) const { return pa * a + pb * b + pc * c; }
  /// How many are zero: 0 inside the triangle, 1 on an edge, 2 at a corner.
  int zeros() const { return (a == 0.0f) + (b == 0.0f) + (c == 0.0f); }
  /// At which corner, where two are zero; on which edge, from corner k to the next, where one is.
  int corner() const { return a > 0.0f ? 0 : b > 0.0f ? 1 : 2; }
  int edge() const { return c == 0.0f ? 0 : a == 0.0f ? 1 : 2; }
};

/// The point of triangle abc closest to p.
Barycentrics closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The points of two triangles that are closest to each other. Of two that cross, any points of them.
struct TrianglePair {
  Barycentrics first, second;
};
TrianglePair closest_between_triangles(const Vec3 (&p)[3], const Vec3 (&q)[3]);

}  // namespace pleat
