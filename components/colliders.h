// Bodies that cloth touches: capsules (a sphere is one of zero length, a tapered one is thicker at one end),
// half-spaces and triangle meshes (a box is one, and so is a convex hull). Each has a previous and a next pose and
// moves from one to the other within a tick: points in a straight line, rotations at a constant rate.
#pragma once

#include <cstdint>
#include <span>

#include "components/column.h"
#include "components/rigid_pose.h"

namespace pleat {

/// What a shape is made of: spheres and tapered capsules are capsules, boxes and hulls are meshes.
enum class ColliderKind : std::uint8_t { kCapsule, kMesh, kPlane };

/// Bits of groups: a body is in some, a cloth collides with some.
inline constexpr std::uint32_t kFirstGroup = 1, kAllGroups = 0xffffffff;

/// Capsules, one element each: the convex hull of a ball about a and one about b. World space, m.
struct CapsuleColumns {
  Vec3Column previous_a, previous_b, next_a, next_b;
  Column<float> radius, taper;  // of the ball about a, m; what the one about b has more, m
  Column<float> thickness;      // kept from it besides the cloth's, m
  Column<float> friction;
  Column<std::uint32_t> groups;  // bits: see pleat_collider_def
  Column<std::uint8_t> enabled;

  explicit CapsuleColumns(std::pmr::memory_resource* m)
      : previous_a(m),
        previous_b(m),
        next_a(m),
        next_b(m),
        radius(m),
        taper(m),
        thickness(m),
        friction(m),
        groups(m),
        enabled(m) {}
  std::size_t size() const { return enabled.size(); }
  /// Whether cloth that collides with the groups of `wanted` meets capsule i.
  bool meets(std::size_t i, std::uint32_t wanted) const { return enabled[i] != 0 && (groups[i] & wanted) != 0; }
};

/// All points below a plane that a rigid frame carries: local y <= 0.
struct PlaneCollider {
  RigidPose previous, next;
  float thickness = 0.0f;  // kept from it besides the cloth's, m
  float friction = 1.0f;
  std::uint32_t groups = kFirstGroup;
  bool enabled = true;

  bool meets(std::uint32_t wanted) const { return enabled && (groups & wanted) != 0; }
};

/// One triangle mesh with outward, counter-clockwise faces.
struct MeshCollider {
  Vec3Column previous, next;                // vertices, world space, m
  Column<std::uint32_t> triangles;          // 3 vertex indices each
  Vec3Column local;                         // of a rigid body: vertices in its own frame, m; else empty
  RigidPose previous_pose, next_pose;       // of a rigid body
  float bow = 0.0f;                         // of a rigid body: how far its turning takes vertices off straight lines, m
  float depth = 0.03f;                      // below the surface from which a particle is still brought back, m
  float thickness = 0.0f, friction = 1.0f;  // kept from it besides the cloth's, m; multiplied by the cloth's
  std::uint32_t groups = kFirstGroup;
  bool enabled = true;

  explicit MeshCollider(std::pmr::memory_resource* m) : previous(m), next(m), triangles(m), local(m) {}
  bool is_rigid() const { return local.size() != 0; }
  bool meets(std::uint32_t wanted) const { return enabled && (groups & wanted) != 0; }
};

/// A world's bodies, of which a cloth meets some.
struct BodiesMet {
  const CapsuleColumns* capsules = nullptr;
  std::span<const MeshCollider* const> meshes{};
  std::span<const PlaneCollider> planes{};
  std::uint32_t collides_with = kAllGroups;
};

/// A capsule at one moment of a substep: where its core is and how far it moves until the substep ends.
struct CapsulePose {
  Vec3 a, b;              // core at the end of the substep, m
  Vec3 step_a, step_b;    // motion of its ends over the substep, m
  float radius = 0.0f;    // of the ball about a with what is to be kept from it, m
  float taper = 0.0f;     // what the ball about b has more, m; shorter than ab
  float friction = 1.0f;  // multiplied by the cloth's
  std::uint32_t index = 0;
};

/// A half-space at one moment of a tick, as seen from `origin`: all points with normal . x <= height.
struct PlanePose {
  Vec3 normal;   // out of the body, unit
  float height;  // with what is to be kept from it, m

  PlanePose(const PlaneCollider& plane, float t, const Vec3& origin = {}) {
    const RigidPose pose = interpolate(plane.previous.from(origin), plane.next.from(origin), t);
    normal = rotate(pose.rotation, {0, 1, 0});
    height = dot(normal, pose.position) + plane.thickness;
  }
};

}  // namespace pleat
