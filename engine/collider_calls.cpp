#include <utility>

#include "engine/border.h"
#include "engine/calls.h"
#include "engine/schedule.h"
#include "engine/sleep.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/collision_bodies.h"
#include "systems/collision_hull.h"
#endif

namespace pleat::call {
namespace {

const pleat_collider_def& default_collider() {
  static const pleat_collider_def def = [] {
    pleat_collider_def d{};
    d.size = sizeof d;
    d.friction = 1.0f;
    d.rotation[3] = 1.0f;
    d.groups = kFirstGroup;
    static_assert(offsetof(pleat_collider_def, reserved) + sizeof d.reserved == sizeof d,
                  "padding would pass for more");
    return d;
  }();
  return def;
}

#ifdef PLEAT_WITH_COLLISION
constexpr std::uint32_t kMostHullPoints = 65536;
constexpr double kMostRadius = 1e4;  // m

void need_settings(const pleat_collider_settings& s) {
  need_range("friction", s.friction, 0, 10);
  need_range("thickness", s.thickness, 0, 1);
  need_range("radius", s.radius, 0, kMostRadius);
  need_range("radius_b", s.radius_b, 0, kMostRadius);
}

RigidPose need_pose(const float position[3], const float rotation[4]) {
  const Vec3 place = need_place("position", position);
  return {place, need_rotation("rotation", rotation)};
}

MeshCollider read_mesh(World& world, const pleat_collider_def& def) {
  need_range("vertex_count", def.vertex_count, 3, 3 * double{kMaxMeshTriangles});
  need_range("triangle_count", def.triangle_count, 1, double{kMaxMeshTriangles});
  const HostVectors positions("positions", def.positions, def.position_stride, def.vertex_count);
  need_pointer("triangles", def.triangles);
  const std::size_t index_count = std::size_t{3} * def.triangle_count;
  for (std::size_t i = 0; i < index_count; ++i) {
    need_index("triangles", i / 3, i % 3, def.triangles[i], def.vertex_count);
  }
  MeshCollider mesh(&world.memory);
  mesh.previous.resize(def.vertex_count);
  mesh.next.resize(def.vertex_count);
  for (std::uint32_t i = 0; i < def.vertex_count; ++i) {
    mesh.previous.view().set(i, positions[i]);
    mesh.next.view().set(i, positions[i]);
  }
  mesh.triangles.resize(index_count);
  std::copy_n(def.triangles, index_count, mesh.triangles.begin());
  return mesh;
}

MeshCollider read_box(World& world, const pleat_collider_def& def) {
  const RigidPose pose = need_pose(def.position, def.rotation);
  for (const float extent : def.half_extents) need_range("half_extents", extent, 1e-4, kMostRadius);
  MeshCollider box = build_box({def.half_extents[0], def.half_extents[1], def.half_extents[2]}, &world.memory);
  place_rigid(box, pose);
  return box;
}

MeshCollider read_hull(World& world, const pleat_collider_def& def) {
  const RigidPose pose = need_pose(def.position, def.rotation);
  need_range("vertex_count", def.vertex_count, 4, kMostHullPoints);
  const HostVectors positions("positions", def.positions, def.position_stride, def.vertex_count);
  std::pmr::vector<Vec3> points(&world.memory);
  for (std::uint32_t i = 0; i < def.vertex_count; ++i) points.push_back(positions[i]);
  MeshCollider hull = build_hull(points, &world.memory);
  if (hull.triangles.size() == 0) refuse("positions lie in a plane: they have no hull with an inside");
  place_rigid(hull, pose);
  return hull;
}

Handle add_collider(World& world, const pleat_collider_def& def) {
  switch (def.shape) {
    case PLEAT_COLLIDER_SPHERE:
      return add_capsule(world, def.shape, need_place("a", def.a), need_place("a", def.a));
    case PLEAT_COLLIDER_CAPSULE:
    case PLEAT_COLLIDER_TAPERED_CAPSULE:
      return add_capsule(world, def.shape, need_place("a", def.a), need_place("b", def.b));
    case PLEAT_COLLIDER_PLANE:
      return add_plane(world, need_pose(def.position, def.rotation));
    case PLEAT_COLLIDER_MESH:
      return add_mesh(world, def.shape, read_mesh(world, def));
    case PLEAT_COLLIDER_BOX:
      return add_mesh(world, def.shape, read_box(world, def));
    default:
      return add_mesh(world, def.shape, read_hull(world, def));
  }
}

/// `body` is a mesh or a plane.
template <class Body>
void set_common(Body& body, const pleat_collider_settings& s) {
  body.friction = s.friction;
  body.thickness = s.thickness;
  body.groups = s.groups;
}

void set_collider(World& world, const ColliderRecord& record, const pleat_collider_settings& s) {
  const std::size_t i = record.position;
  switch (record.kind) {
    case ColliderKind::kCapsule:
      world.capsules.friction[i] = s.friction;
      world.capsules.thickness[i] = s.thickness;
      world.capsules.groups[i] = s.groups;
      world.capsules.radius[i] = s.radius;
      world.capsules.taper[i] = record.shape == PLEAT_COLLIDER_TAPERED_CAPSULE ? s.radius_b - s.radius : 0.0f;
      world.capsules_filed = false;
      break;
    case ColliderKind::kMesh:
      set_common(world.meshes[i].mesh, s);
      break;
    case ColliderKind::kPlane:
      set_common(world.planes[i], s);
      break;
  }
}

pleat_collider_settings settings_of(const World& world, const ColliderRecord& record) {
  const std::size_t i = record.position;
  const CapsuleColumns& c = world.capsules;
  constexpr auto size = static_cast<std::uint32_t>(sizeof(pleat_collider_settings));
  switch (record.kind) {
    case ColliderKind::kCapsule:
      return {size, c.friction[i], c.thickness[i], c.radius[i], c.radius[i] + c.taper[i], c.groups[i]};
    case ColliderKind::kMesh: {
      const MeshCollider& mesh = world.meshes[i].mesh;
      return {size, mesh.friction, mesh.thickness, 0.0f, 0.0f, mesh.groups};
    }
    case ColliderKind::kPlane:
      break;
  }
  const PlaneCollider& plane = world.planes[i];
  return {size, plane.friction, plane.thickness, 0.0f, 0.0f, plane.groups};
}

/// What it was.
bool set_enabled(World& world, const ColliderRecord& record, bool enabled) {
  switch (record.kind) {
    case ColliderKind::kCapsule:
      world.capsules_filed = false;
      return std::exchange(world.capsules.enabled[record.position], enabled ? 1 : 0) != 0;
    case ColliderKind::kMesh:
      return std::exchange(world.meshes[record.position].mesh.enabled, enabled);
    case ColliderKind::kPlane:
      break;
  }
  return std::exchange(world.planes[record.position].enabled, enabled);
}

const ColliderRecord& need_collider(const World& world, pleat_collider id) {
  return world.colliders[need_handle("collider", world.collider_handles, id)];
}
#endif

}  // namespace

pleat_result collider_def_init(pleat_collider_def* def, size_t size) {
  return init_def("collider_def_init", def, size, default_collider());
}

pleat_result collider_create(pleat_world* handle, const pleat_collider_def* given, pleat_collider* collider) {
  return guarded(as_world(handle), "collider_create", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_pointer("collider", collider);
    const pleat_collider_def def = read_def("def", given, default_collider());
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
    need_range("shape", def.shape, 0, PLEAT_COLLIDER_HULL);
    need_range("reserved", def.reserved, 0, 0);
#ifdef PLEAT_WITH_COLLISION
    const pleat_collider_settings settings{sizeof settings, def.friction, def.thickness,
                                           def.radius,      def.radius_b, def.groups};
    need_settings(settings);
    const std::size_t before = world.colliders.size();
    const BodyCensus census = body_census(world);
    try {
      const Handle added = add_collider(world, def);
      set_collider(world, world.colliders.back(), settings);
      replan(world, census, settings.groups);
      *collider = {added.index, added.generation};
    } catch (...) {
      if (world.colliders.size() != before) remove_collider(world, static_cast<std::uint32_t>(before));
      drop_idle_bodies(world);
      throw;
    }
#endif
  });
}

pleat_result collider_destroy(pleat_world* handle, [[maybe_unused]] pleat_collider collider) {
  return guarded(as_world(handle), "collider_destroy", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const BodyCensus census = body_census(world);
    const std::uint32_t position = need_handle("collider", world.collider_handles, collider);
    const std::uint32_t groups = settings_of(world, world.colliders[position]).groups;
    remove_collider(world, position);
    replan(world, census, groups);
#endif
  });
}

pleat_result collider_set_enabled(pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                                  [[maybe_unused]] uint32_t enabled) {
  return guarded(as_world(handle), "collider_set_enabled", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const ColliderRecord& record = need_collider(world, collider);
    const bool was = set_enabled(world, record, enabled != 0);
    if (was != (enabled != 0)) wake_who_meets(world, settings_of(world, record).groups);
#endif
  });
}

pleat_result collider_move_capsule(pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                                   [[maybe_unused]] const float a[3], [[maybe_unused]] const float b[3]) {
  return guarded(as_world(handle), "collider_move_capsule", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const ColliderRecord& record = need_collider(world, collider);
    if (record.kind != ColliderKind::kCapsule) refuse("collider is not a capsule or a sphere");
    const float* end = record.shape == PLEAT_COLLIDER_SPHERE ? a : b;
    const Vec3 next_a = need_place("a", a), next_b = need_place("b", end);
    world.capsules.next_a.view().set(record.position, next_a);
    world.capsules.next_b.view().set(record.position, next_b);
#endif
  });
}

pleat_result collider_move_mesh(pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                                [[maybe_unused]] const float* positions, [[maybe_unused]] uint32_t stride,
                                [[maybe_unused]] uint32_t count) {
  return guarded(as_world(handle), "collider_move_mesh", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const ColliderRecord& body = need_collider(world, collider);
    if (body.shape != PLEAT_COLLIDER_MESH) refuse("collider is not a mesh");
    MeshRecord& record = world.meshes[body.position];
    MeshCollider& mesh = record.mesh;
    if (count != mesh.next.size()) {
      refuse("count is " + std::to_string(count) + ", the mesh has " + std::to_string(mesh.next.size()) + " vertices");
    }
    const HostVectors host("positions", positions, stride, count);
    for (std::uint32_t i = 0; i < count; ++i) mesh.next.view().set(i, host[i]);
    record.stale_ticks = 2;
#endif
  });
}

pleat_result collider_move_rigid(pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                                 [[maybe_unused]] const float position[3], [[maybe_unused]] const float rotation[4]) {
  return guarded(as_world(handle), "collider_move_rigid", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const ColliderRecord& body = need_collider(world, collider);
    const bool rigid_mesh = body.kind == ColliderKind::kMesh && world.meshes[body.position].mesh.is_rigid();
    if (!rigid_mesh && body.kind != ColliderKind::kPlane) refuse("collider is not a plane, a box or a hull");
    const RigidPose pose = need_pose(position, rotation);
    if (rigid_mesh) {
      move_rigid(world.meshes[body.position].mesh, pose);
      world.meshes[body.position].stale_ticks = 2;
    } else {
      world.planes[body.position].next = pose;
    }
#endif
  });
}

pleat_result collider_get(const pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                          [[maybe_unused]] pleat_collider_settings* settings) {
  return guarded(as_world(handle), "collider_get", [&] {
    [[maybe_unused]] const World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    write_sized("settings", settings, settings_of(world, need_collider(world, collider)));
#endif
  });
}

pleat_result collider_set(pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                          [[maybe_unused]] const pleat_collider_settings* settings) {
  return guarded(as_world(handle), "collider_set", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const ColliderRecord& record = need_collider(world, collider);
    const pleat_collider_settings old = settings_of(world, record), wanted = read_def("settings", settings, old);
    need_settings(wanted);
    set_collider(world, record, wanted);
    if (!same_bytes(settings_of(world, record), old)) wake_who_meets(world, old.groups | wanted.groups);
#endif
  });
}

}  // namespace pleat::call
