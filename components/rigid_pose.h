// Where a rigid body is: a rotation about its origin, and where that is.
#pragma once

#include "components/vec3.h"

namespace pleat {

/// A rotation as a unit quaternion, w its scalar part.
struct Quaternion {
  float x = 0.0f, y = 0.0f, z = 0.0f, w = 1.0f;

  friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

inline float dot(const Quaternion& p, const Quaternion& q) { return p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w; }

/// How far the rotation moves v: exactly zero where it is none.
inline Vec3 turn(const Quaternion& q, const Vec3& v) {
  const Vec3 axis{q.x, q.y, q.z}, t = cross(axis, v) * 2.0f;
  return t * q.w + cross(axis, t);
}
inline Vec3 rotate(const Quaternion& q, const Vec3& v) { return v + turn(q, v); }

inline Quaternion conjugate(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// First q, then p.
inline Quaternion operator*(const Quaternion& p, const Quaternion& q) {
  return {p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y, p.w * q.y + p.y * q.w + p.z * q.x - p.x * q.z,
          p.w * q.z + p.z * q.w + p.x * q.y - p.y * q.x, p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z};
}

/// The rotation at the fraction t on the shorter way from p to q, at a constant rate.
///   K. Shoemake, Animating Rotation with Quaternion Curves, 1985.
inline Quaternion slerp(const Quaternion& p, const Quaternion& q, float t) {
  if (p == q) return p;
  const float cosine = dot(p, q), sign = cosine < 0.0f ? -1.0f : 1.0f;
  float of_p = 1.0f - t, of_q = t;
  if (sign * cosine < 0.9999f) {  // nearer ones turn at a constant rate along the chord too, up to rounding
    const float angle = std::acos(sign * cosine), scale = 1.0f / std::sin(angle);
    of_p = std::sin(of_p * angle) * scale, of_q = std::sin(of_q * angle) * scale;
  }
  of_q *= sign;
  const Quaternion r{p.x * of_p + q.x * of_q, p.y * of_p + q.y * of_q, p.z * of_p + q.z * of_q,
                     p.w * of_p + q.w * of_q};
  const float scale = 1.0f / std::sqrt(dot(r, r));
  return {r.x * scale, r.y * scale, r.z * scale, r.w * scale};
}

/// From the body's own frame to the world.
struct RigidPose {
  Vec3 position;  // m
  Quaternion rotation;

  Vec3 apply(const Vec3& local) const { return position + rotate(rotation, local); }
  /// As seen from `origin`.
  RigidPose from(const Vec3& origin) const { return {position - origin, rotation}; }
  friend bool operator==(const RigidPose&, const RigidPose&) = default;
};

/// The origin moves in a straight line, the rotation at a constant rate.
inline RigidPose interpolate(const RigidPose& p, const RigidPose& q, float t) {
  return {p.position + (q.position - p.position) * t, slerp(p.rotation, q.rotation, t)};
}

/// Carries points of the world: a turn about `from`, which is brought to `to`.
struct RigidMotion {
  Vec3 from, to;  // m
  Quaternion rotation;

  Vec3 apply(const Vec3& p) const { return to + rotate(rotation, p - from); }
  /// The same of points that are moved by `by`.
  RigidMotion moved(const Vec3& by) const { return {from + by, to + by, rotation}; }
  /// This one first.
  RigidMotion then(const RigidMotion& next) const { return {from, next.apply(to), next.rotation * rotation}; }
  /// The same, told of another point.
  RigidMotion about(const Vec3& p) const { return {p, apply(p), rotation}; }
};

/// How a rigid body gets from one pose to another.
struct RigidStep {
  Vec3 origin;      // at the end, m
  Vec3 moved;       // by the origin, m
  Quaternion back;  // the rotation, undone

  RigidStep(const RigidPose& begin, const RigidPose& end)
      : origin(end.position), moved(end.position - begin.position), back(begin.rotation * conjugate(end.rotation)) {}
  /// Motion of the body's point that ends up at p, m.
  Vec3 at(const Vec3& p) const { return moved - turn(back, p - origin); }
};

}  // namespace pleat
