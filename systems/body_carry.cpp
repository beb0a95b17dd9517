#include "systems/body_carry.h"

#include "systems/collision_hull.h"

namespace pleat {
namespace {

/// By how much less `motion` leaves from a point to its next place, m2.
float gain(const RigidMotion& motion, const Vec3& previous, const Vec3& next) {
  const Vec3 before = next - previous, after = next - motion.apply(previous);
  return dot(before, before) - dot(after, after);
}

RigidPose carried(const RigidMotion& motion, const RigidPose& pose) {
  return {motion.apply(pose.position), motion.rotation * pose.rotation};
}

}  // namespace

void carry_along(const RigidMotion& motion, CapsuleColumns& capsules) {
  const Vec3View a = capsules.previous_a.view(), b = capsules.previous_b.view();
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    const Vec3 next_a = capsules.next_a.view()[i], next_b = capsules.next_b.view()[i];
    if (gain(motion, a[i], next_a) + gain(motion, b[i], next_b) <= 0.0f) continue;
    a.set(i, motion.apply(a[i]));
    b.set(i, motion.apply(b[i]));
  }
}

void carry_along(const RigidMotion& motion, MeshCollider& mesh) {
  const Vec3View previous = mesh.previous.view();
  float sum = 0.0f;
  for (std::size_t i = 0; i < mesh.next.size(); ++i) sum += gain(motion, previous[i], mesh.next.view()[i]);
  if (sum <= 0.0f) return;
  for (std::size_t i = 0; i < mesh.next.size(); ++i) previous.set(i, motion.apply(previous[i]));
  if (!mesh.is_rigid()) return;
  mesh.previous_pose = carried(motion, mesh.previous_pose);
  move_rigid(mesh, mesh.next_pose);  // with a shorter way to go
}

void carry_along(const RigidMotion& motion, PlaneCollider& plane) {
  if (gain(motion, plane.previous.position, plane.next.position) > 0.0f) {
    plane.previous = carried(motion, plane.previous);
  }
}

}  // namespace pleat
