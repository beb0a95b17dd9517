// Bodies come and go: their data, their places in the trees, their handles.
#include "engine/world.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/collision_bodies.h"

namespace pleat {
namespace {

/// Everything that adding a collider needs besides its own data.
void want_room(World& world) {
  world.collider_handles.reserve_one();
  reserve_one_more(world.colliders);
}

void want_bodies(World& world) {
  if (world.bodies != nullptr) return;
  std::pmr::polymorphic_allocator<> allocator(&world.memory);
  world.bodies = {allocator.new_object<CollisionBodies>(&world.memory), MemoryDelete{&world.memory}};
}

void point_at_meshes(World& world) {
  world.mesh_pointers.clear();
  for (const MeshRecord& record : world.meshes) world.mesh_pointers.push_back(&record.mesh);
}

Handle enter(World& world, std::uint32_t shape, ColliderKind kind, std::size_t position) {
  world.colliders.push_back({shape, kind, static_cast<std::uint32_t>(position)});
  return world.collider_handles.add();
}

template <class Call>
void for_each_column(CapsuleColumns& c, const Call& call) {
  for (Vec3Column* column : {&c.previous_a, &c.previous_b, &c.next_a, &c.next_b}) call(*column);
  for (Column<float>* column : {&c.radius, &c.taper, &c.thickness, &c.friction}) call(*column);
  call(c.groups);
  call(c.enabled);  // last: it is what size() goes by
}

}  // namespace

Handle add_capsule(World& world, std::uint32_t shape, const Vec3& a, const Vec3& b) {
  want_room(world);
  want_bodies(world);
  CapsuleColumns& c = world.capsules;
  const std::size_t i = c.size();
  for_each_column(c, [i](auto& column) { column.resize(i + 1); });
  c.previous_a.view().set(i, a), c.next_a.view().set(i, a);
  c.previous_b.view().set(i, b), c.next_b.view().set(i, b);
  c.friction[i] = 1.0f;
  c.groups[i] = kFirstGroup;
  c.enabled[i] = 1;
  world.capsules_filed = false;
  return enter(world, shape, ColliderKind::kCapsule, i);
}

Handle add_mesh(World& world, std::uint32_t shape, MeshCollider&& mesh) {
  want_room(world);
  want_bodies(world);
  world.mesh_pointers.reserve(world.meshes.size() + 1);
  world.meshes.emplace_back(std::move(mesh));
  try {
    world.bodies->add_mesh(world.meshes.back().mesh);
  } catch (...) {
    world.meshes.pop_back();
    throw;
  }
  point_at_meshes(world);
  return enter(world, shape, ColliderKind::kMesh, world.meshes.size() - 1);
}

Handle add_plane(World& world, const RigidPose& pose) {
  want_room(world);
  world.planes.push_back({.previous = pose, .next = pose});
  return enter(world, PLEAT_COLLIDER_PLANE, ColliderKind::kPlane, world.planes.size() - 1);
}

void remove_collider(World& world, std::uint32_t position) {
  const ColliderRecord gone = world.colliders[position];
  switch (gone.kind) {
    case ColliderKind::kCapsule:
      for_each_column(world.capsules, [&gone](auto& column) { column.erase(gone.position, 1); });
      world.capsules_filed = false;
      break;
    case ColliderKind::kMesh:
      world.bodies->remove_mesh(gone.position);
      world.meshes.erase(world.meshes.begin() + gone.position);
      point_at_meshes(world);
      break;
    case ColliderKind::kPlane:
      world.planes.erase(gone.position, 1);
      break;
  }
  world.colliders.erase(world.colliders.begin() + position);
  for (ColliderRecord& other : world.colliders) {
    if (other.kind == gone.kind && other.position > gone.position) --other.position;
  }
  world.collider_handles.remove(position);
  drop_idle_bodies(world);
}

void drop_idle_bodies(World& world) {
  if (world.capsules.size() == 0 && world.meshes.empty()) world.bodies.reset();
}

}  // namespace pleat
#endif
