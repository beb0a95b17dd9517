#include "systems/capsule_shape.h"

#include <limits>

namespace pleat {
namespace {

using Vec3d = Vec3T<double>;

Vec3d difference(const Vec3& a, const Vec3& b) {
  return {double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z}};
}

/// The infinite cone that the wall of a tapered capsule belongs to, seen from a.
struct Cone {
  Vec3d axis;              // unit, from a to b
  double length, tangent;  // of the core, m; by how much the nearest ball lies off, for each metre beside the axis

  explicit Cone(const CapsulePose& c) : axis(difference(c.b, c.a)), length(pleat::length(axis)) {
    const double taper = double{c.taper}, wall2 = length * length - taper * taper;
    axis *= 1.0 / std::max(length, 1e-30);
    tangent = taper / std::sqrt(std::max(wall2, 1e-12 * taper * taper));  // one ball nearly holds the other: far off
  }
};

float closest_on_cone(const Vec3d& from_a, const Cone& cone) {
  const double along = dot(from_a, cone.axis), beside = length(from_a - cone.axis * along);
  return static_cast<float>(std::clamp((along + cone.tangent * beside) / std::max(cone.length, 1e-30), 0.0, 1.0));
}

}  // namespace

float closest_on_tapered(const Vec3& p, const CapsulePose& c) { return closest_on_cone(difference(p, c.a), Cone(c)); }

SegmentPair closest_to_tapered(const Vec3& p0, const Vec3& p1, const CapsulePose& c) {
  const Cone cone(c);
  const Vec3d from_a = difference(p0, c.a), along = difference(p1, p0);
  SegmentPair best{0.0f, 0.0f};
  float least = std::numeric_limits<float>::max();
  const auto consider = [&](float s, float t) {
    const float distance = length(lerp(p0, p1, s) - lerp(c.a, c.b, t)) - radius_at(c, t);
    if (distance < least) best = {s, t}, least = distance;
  };
  // The least of a convex function on a square is on its rim or where both slopes vanish: at an end of the segment,
  // at an end of the core, or where the segment is closest to the cone.
  consider(0.0f, closest_on_cone(from_a, cone));
  consider(1.0f, closest_on_cone(from_a + along, cone));
  consider(closest_on_segment(c.a, p0, p1), 0.0f);
  consider(closest_on_segment(c.b, p0, p1), 1.0f);

  // Beside the axis the segment is at sqrt(A s^2 + 2 B s + C). Its slope there, (A s + B) / sqrt(...), has to make up
  // for how fast the cone widens along it.
  const Vec3d beside = along - cone.axis * dot(along, cone.axis), start = from_a - cone.axis * dot(from_a, cone.axis);
  const double A = dot(beside, beside), B = dot(beside, start), C = dot(start, start);
  if (A <= 1e-14 * dot(along, along)) return best;
  const double slope = cone.tangent * dot(along, cone.axis) / std::sqrt(A);
  if (std::abs(slope) >= 1.0) return best;
  const double apart = std::sqrt(std::max(C / A - B * B / (A * A), 0.0));
  const double s = -B / A + apart * slope / std::sqrt(1.0 - slope * slope);
  if (s > 0.0 && s < 1.0) consider(static_cast<float>(s), closest_on_cone(from_a + along * s, cone));
  return best;
}

CapsuleGap gap_to_triangle(const CapsulePose& capsule, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 corner[] = {a, b, c, a};
  CapsuleGap gap{{}, std::numeric_limits<float>::max()};
  const auto consider = [&](const Vec3& away, float t) {
    const float distance = length(away) - radius_at(capsule, t);
    if (distance < gap.distance) gap = {away, distance};
  };
  for (int k = 0; k < 3; ++k) {
    const SegmentPair at = closest_to_capsule(corner[k], corner[k + 1], capsule);
    consider(lerp(corner[k], corner[k + 1], at.s) - lerp(capsule.a, capsule.b, at.t), at.t);
  }
  const Vec3 u = b - a, v = c - a, area = cross(u, v);
  const float area2 = dot(area, area);
  for (const float t : {0.0f, 1.0f}) {
    const Vec3 w = (t == 0.0f ? capsule.a : capsule.b) - a;
    const float wb = dot(cross(w, v), area), wc = dot(cross(u, w), area);
    if (wb > 0.0f && wc > 0.0f && wb + wc < area2) consider(area * (-dot(w, area) / area2), t);
  }
  return gap;
}

void drop_swallowed_end(CapsulePose& c) {
  const Vec3 core = c.b - c.a;
  if (c.taper == 0.0f || dot(core, core) > c.taper * c.taper * 1.0001f) return;
  if (c.taper > 0.0f) {
    c.a = c.b, c.step_a = c.step_b, c.radius += c.taper;
  } else {
    c.b = c.a, c.step_b = c.step_a;
  }
  c.taper = 0.0f;
}

}  // namespace pleat
