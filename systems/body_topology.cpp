#include "systems/body_topology.h"

#include <algorithm>

namespace pleat {
namespace {

struct HalfEdge {
  std::uint32_t low, high, slot;  // slot = 3 triangle + k

  bool same_edge(const HalfEdge& b) const { return low == b.low && high == b.high; }
  friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

void join_neighbours(const MeshCollider& mesh, BodyTopology& topology, std::pmr::memory_resource* memory) {
  const std::size_t slots = mesh.triangles.size();
  Column<HalfEdge> edges(memory);
  edges.resize(slots);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const std::uint32_t triangle = slot / 3, k = slot % 3;
    const auto [low, high] = std::minmax({mesh.triangles[slot], mesh.triangles[3 * triangle + (k + 1) % 3]});
    edges[slot] = {low, high, slot};
  }
  std::sort(edges.begin(), edges.end());
  topology.neighbour.resize(slots);
  std::fill(topology.neighbour.begin(), topology.neighbour.end(), kNoTriangle);
  for (std::size_t i = 0; i < slots; ++i) {
    const std::uint32_t slot = edges[i].slot;
    topology.owned[slot / 3] = static_cast<std::uint8_t>(topology.owned[slot / 3] | 1 << (3 + slot % 3));
    if (i + 1 == slots || !edges[i].same_edge(edges[i + 1])) continue;
    const std::uint32_t other = edges[++i].slot;
    topology.neighbour[slot] = other / 3;
    topology.neighbour[other] = slot / 3;
  }
}

void gather_rings(const MeshCollider& mesh, BodyTopology& topology) {
  topology.ring_begin.resize(mesh.next.size() + 1);
  topology.ring.resize(mesh.triangles.size());
  for (const std::uint32_t v : mesh.triangles) ++topology.ring_begin[v];
  std::uint32_t end = 0;
  for (std::uint32_t& begin : topology.ring_begin) begin = end += begin;
  // Filled from the back, each count has become the begin of its vertex when its last triangle is in.
  for (std::size_t slot = mesh.triangles.size(); slot-- > 0;) {
    topology.ring[--topology.ring_begin[mesh.triangles[slot]]] = static_cast<std::uint32_t>(slot / 3);
  }
  for (std::uint32_t slot = 0; slot < mesh.triangles.size(); ++slot) {
    const std::uint32_t triangle = slot / 3, begin = topology.ring_begin[mesh.triangles[slot]];
    if (topology.ring[begin] == triangle) {
      topology.owned[triangle] = static_cast<std::uint8_t>(topology.owned[triangle] | 1 << slot % 3);
    }
  }
}

}  // namespace

BodyTopology build_body_topology(const MeshCollider& mesh, std::pmr::memory_resource* memory) {
  BodyTopology topology(memory);
  topology.owned.resize(mesh.triangles.size() / 3);
  join_neighbours(mesh, topology, memory);
  gather_rings(mesh, topology);
  return topology;
}

}  // namespace pleat
