#include "engine/border.h"
#include "engine/calls.h"
#include "engine/schedule.h"

namespace pleat::call {
namespace {

const pleat_collider_def& default_collider() {
  static const pleat_collider_def def = [] {
    pleat_collider_def d{};
    d.size = sizeof d;
    d.friction = 1.0f;
    return d;
  }();
  return def;
}

#ifdef PLEAT_WITH_COLLISION
constexpr std::uint32_t kMostBodyTriangles = 2'000'000;

Vec3 as_vec3(const float v[3]) { return {v[0], v[1], v[2]}; }

void need_inside(const char* name, const float v[3]) {
  need_finite(name, v);
  for (int k = 0; k < 3; ++k) need_range(name, v[k], -1e6, 1e6);
}

MeshCollider read_mesh(World& world, const pleat_collider_def& def) {
  need_range("vertex_count", def.vertex_count, 3, 3 * double{kMostBodyTriangles});
  need_range("triangle_count", def.triangle_count, 1, kMostBodyTriangles);
  const HostVectors positions("positions", def.positions, def.position_stride, def.vertex_count);
  need_pointer("triangles", def.triangles);
  const std::size_t index_count = std::size_t{3} * def.triangle_count;
  for (std::size_t i = 0; i < index_count; ++i) {
    if (def.triangles[i] >= def.vertex_count) {
      refuse("triangles[" + std::to_string(i / 3) + "][" + std::to_string(i % 3) + "] is " +
             std::to_string(def.triangles[i]) + ", there are " + std::to_string(def.vertex_count) + " vertices");
    }
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
  mesh.friction = def.friction;
  return mesh;
}

ColliderRecord need_collider(const World& world, pleat_collider id, std::uint32_t shape, const char* shape_name) {
  const ColliderRecord record = world.colliders[need_handle("collider", world.collider_handles, id)];
  if (record.shape != shape) refuse(std::string("collider is not a ") + shape_name);
  return record;
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
    need_range("shape", def.shape, 0, PLEAT_COLLIDER_MESH);
    need_range("friction", def.friction, 0, 10);
#ifdef PLEAT_WITH_COLLISION
    const std::size_t before = world.colliders.size();
    try {
      Handle added;
      if (def.shape == PLEAT_COLLIDER_CAPSULE) {
        need_inside("a", def.a);
        need_inside("b", def.b);
        need_range("radius", def.radius, 0, 1e4);
        added = add_capsule(world, as_vec3(def.a), as_vec3(def.b), def.radius, def.friction);
      } else {
        added = add_mesh(world, read_mesh(world, def));
      }
      replan(world);
      *collider = {added.index, added.generation};
    } catch (...) {
      if (world.colliders.size() != before) remove_collider(world, static_cast<std::uint32_t>(before));
      drop_idle_bodies(world);
      replan(world);  // to what it was: there is room for it
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
    remove_collider(world, need_handle("collider", world.collider_handles, collider));
    replan(world);
#endif
  });
}

pleat_result collider_set_enabled(pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                                  [[maybe_unused]] uint32_t enabled) {
  return guarded(as_world(handle), "collider_set_enabled", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const ColliderRecord record = world.colliders[need_handle("collider", world.collider_handles, collider)];
    if (record.shape == PLEAT_COLLIDER_CAPSULE) {
      world.capsules.enabled[record.position] = enabled != 0 ? 1 : 0;
    } else {
      world.meshes[record.position].mesh.enabled = enabled != 0;
    }
#endif
  });
}

pleat_result collider_move_capsule(pleat_world* handle, [[maybe_unused]] pleat_collider collider,
                                   [[maybe_unused]] const float a[3], [[maybe_unused]] const float b[3]) {
  return guarded(as_world(handle), "collider_move_capsule", [&] {
    [[maybe_unused]] World& world = need_world(handle);
    need_compiled(kHasCollision, "a collider", "PLEAT_COLLISION");
#ifdef PLEAT_WITH_COLLISION
    const ColliderRecord record = need_collider(world, collider, PLEAT_COLLIDER_CAPSULE, "capsule");
    need_inside("a", a);
    need_inside("b", b);
    world.capsules.next_a.view().set(record.position, as_vec3(a));
    world.capsules.next_b.view().set(record.position, as_vec3(b));
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
    MeshRecord& record = world.meshes[need_collider(world, collider, PLEAT_COLLIDER_MESH, "mesh").position];
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

}  // namespace pleat::call
