// How the triangles of a mesh body hang together. Built once; poses may change, this does not.
#pragma once

#include <cstdint>

#include "components/colliders.h"

namespace pleat {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// Edge k of a triangle joins its corners k and (k + 1) % 3. So that a pair of meshes meets each pair of features once,
/// every vertex and every edge is owned by one of its triangles ("representative triangles": S. Curtis, R. Tamstorf,
/// D. Manocha, Fast Collision Detection for Deformable Models using Representative-Triangles, 2008).
struct BodyTopology {
  Column<std::uint32_t> neighbour;         // 3 a triangle: the one across edge k, or kNoTriangle at a border
  Column<std::uint8_t> owned;              // 1 a triangle: bit k = its corner k, bit 3 + k = its edge k
  Column<std::uint32_t> ring_begin, ring;  // triangles around vertex v: ring[ring_begin[v] .. ring_begin[v + 1])

  explicit BodyTopology(std::pmr::memory_resource* m) : neighbour(m), owned(m), ring_begin(m), ring(m) {}
  bool owns_corner(std::uint32_t triangle, int k) const { return (owned[triangle] >> k & 1) != 0; }
  bool owns_edge(std::uint32_t triangle, int k) const { return (owned[triangle] >> (3 + k) & 1) != 0; }
};

/// mesh: every index < its vertex count. An edge with more than two triangles is paired as far as it goes; what is left
/// counts as border. Throws std::bad_alloc.
BodyTopology build_body_topology(const MeshCollider& mesh, std::pmr::memory_resource* memory);

}  // namespace pleat
