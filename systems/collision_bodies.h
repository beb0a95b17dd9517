// The bodies in trees: which capsules (Bullet's dynamic tree) and which triangles (in the order of Bullet's tree over a
// mesh, box_tree.h) are near a box. It owns all Bullet objects; questions are read-only, so any number of threads may
// ask at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <memory_resource>

#include "components/colliders.h"
#include "systems/body_topology.h"
#include "systems/box.h"
#include "systems/box_tree.h"

namespace pleat {

/// A mesh body can have no more triangles than this: Bullet's compressed tree keeps an index in 21 bits.
inline constexpr std::size_t kMaxMeshTriangles = (std::size_t{1} << 21) - 1;

class CollisionBodies {
 public:
  /// Columns take their memory from `memory`, Bullet's trees from Bullet's own allocator.
  explicit CollisionBodies(std::pmr::memory_resource* memory);
  ~CollisionBodies();
  CollisionBodies(CollisionBodies&&) noexcept;
  CollisionBodies& operator=(CollisionBodies&&) noexcept;

  /// Once a tick: files each enabled capsule under the box that it sweeps from its previous to its next pose.
  void update_capsules(const CapsuleColumns& capsules);

  /// Meshes are numbered in the order of adding; removing one closes the gap. mesh: 1 .. kMaxMeshTriangles triangles.
  void add_mesh(const MeshCollider& mesh);
  void remove_mesh(std::size_t index);
  /// In every tick in which previous or next changed: files each triangle under the box it sweeps.
  void update_mesh(std::size_t index, const MeshCollider& mesh);

  std::size_t mesh_count() const;
  /// Another one whenever a mesh was added, removed or updated, as long as these bodies live.
  std::uint64_t revision() const;
  /// Between its previous and its next pose, as it was last updated.
  bool any_mesh_moves() const;
  const BodyTopology& topology(std::size_t mesh) const;
  const Box& swept_box(std::size_t mesh) const;
  /// Of the triangles, with the boxes they sweep, in the order in which for_each_triangle comes to them.
  const BoxTree& triangle_boxes(std::size_t mesh) const;

  /// visit(index) for every capsule, or triangle of a mesh, whose swept box overlaps `box` (and for some others). Order
  /// depends on the tree: sort where it matters.
  template <class Visit>
  void for_each_capsule(const Box& box, const Visit& visit) const {
    find_capsules(box, {&visit, &call<Visit>});
  }
  template <class Visit>
  void for_each_triangle(std::size_t mesh, const Box& box, const Visit& visit) const {
    find_triangles(mesh, box, {&visit, &call<Visit>});
  }

 private:
  struct Trees;
  struct Visitor {
    const void* visit;
    void (*call)(const void* visit, std::uint32_t index);
  };
  template <class Visit>
  static void call(const void* visit, std::uint32_t index) {
    (*static_cast<const Visit*>(visit))(index);
  }
  void find_capsules(const Box& box, Visitor visitor) const;
  void find_triangles(std::size_t mesh, const Box& box, Visitor visitor) const;

  std::unique_ptr<Trees> trees_;
};

}  // namespace pleat
