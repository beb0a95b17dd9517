// Where a point or a segment comes closest to a capsule, tapered or not.
//
// A capsule is the union of balls about the points c(t) of its core, of radius r(t), linear in t. The distance of p is
// the least of |p - c(t)| - r(t), which is convex in t; so is that of a segment x(s) in s and t together. The nearest
// ball of a tapered capsule is not the one abreast of p but the one whose surface p looks at squarely: it lies off by
// the slant of the wall.
#pragma once

#include "components/colliders.h"
#include "systems/closest_points.h"

namespace pleat {

inline float radius_at(const CapsulePose& c, float t) { return c.radius + c.taper * t; }
inline float widest_radius(const CapsulePose& c) { return c.radius + std::max(c.taper, 0.0f); }

/// Where the ball at one end holds the other, they are that ball.
void drop_swallowed_end(CapsulePose& c);

/// t of the ball whose surface is closest to p.
float closest_on_tapered(const Vec3& p, const CapsulePose& c);
inline float closest_on_capsule(const Vec3& p, const CapsulePose& c) {
  return c.taper == 0.0f ? closest_on_segment(p, c.a, c.b) : closest_on_tapered(p, c);
}

/// s of the point of the segment p0 p1, and t of the ball, whose surface it is closest to.
SegmentPair closest_to_tapered(const Vec3& p0, const Vec3& p1, const CapsulePose& c);
inline SegmentPair closest_to_capsule(const Vec3& p0, const Vec3& p1, const CapsulePose& c) {
  return c.taper == 0.0f ? closest_between_segments(p0, p1, c.a, c.b) : closest_to_tapered(p0, p1, c);
}

/// From the surface to p, m; negative inside.
inline float signed_distance(const Vec3& p, const CapsulePose& c) {
  const float t = closest_on_capsule(p, c);
  return length(p - lerp(c.a, c.b, t)) - radius_at(c, t);
}

/// From a capsule to a triangle, where they come closest.
struct CapsuleGap {
  Vec3 away;       // from the core to the point of the triangle, m; short or zero where they cross
  float distance;  // between the surfaces, m; negative inside
};
/// The two come closest on a side of the triangle or at an end of the core that is over its inside. Not looked at: a
/// core that goes through the triangle.
CapsuleGap gap_to_triangle(const CapsulePose& capsule, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace pleat
