#include "systems/body_topology.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

TEST(BodyTopology, ClosedMeshHasNoBorderAndOwnsEveryFeatureOnce) {
  const BodyShape sphere = icosphere(2, 1.0f);
  const MeshCollider mesh = make_body(sphere.positions, sphere.triangles);
  const BodyTopology topology = build_body_topology(mesh, memory());
  std::set<std::uint32_t> corners;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  int owned_corners = 0, owned_edges = 0;
  for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t i = sphere.triangles[t][k], j = sphere.triangles[t][(k + 1) % 3];
      const std::uint32_t across = topology.neighbour[3 * t + k];
      ASSERT_NE(across, kNoTriangle);
      const Triangle& other = sphere.triangles[across];
      EXPECT_EQ(std::count(other.begin(), other.end(), i) + std::count(other.begin(), other.end(), j), 2);
      EXPECT_NE(across, t);
      if (topology.owns_corner(t, static_cast<int>(k))) corners.insert(i), ++owned_corners;
      if (topology.owns_edge(t, static_cast<int>(k))) edges.insert(std::minmax(i, j)), ++owned_edges;
    }
  }
  EXPECT_EQ(owned_corners, 162);
  EXPECT_EQ(corners.size(), 162u);
  EXPECT_EQ(owned_edges, 480);
  EXPECT_EQ(edges.size(), 480u);
}

TEST(BodyTopology, RingsListEveryTriangleAroundAVertex) {
  const BodyShape sphere = icosphere(1, 1.0f);
  const MeshCollider mesh = make_body(sphere.positions, sphere.triangles);
  const BodyTopology topology = build_body_topology(mesh, memory());
  for (std::uint32_t v = 0; v < sphere.positions.size(); ++v) {
    const std::uint32_t begin = topology.ring_begin[v], end = topology.ring_begin[v + 1];
    EXPECT_EQ(end - begin, v < 12 ? 5u : 6u);
    for (std::uint32_t r = begin; r < end; ++r) {
      const Triangle& t = sphere.triangles[topology.ring[r]];
      EXPECT_EQ(std::count(t.begin(), t.end(), v), 1);
    }
  }
}

TEST(BodyTopology, BordersAndThirdTrianglesHaveNoNeighbour) {
  // Two triangles on edge 0-1, a third one on the same edge, and a vertex that no triangle uses.
  const MeshCollider mesh =
      make_body({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {9, 9, 9}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const BodyTopology topology = build_body_topology(mesh, memory());
  EXPECT_EQ(topology.neighbour[0], 1u);
  EXPECT_EQ(topology.neighbour[3], 0u);
  EXPECT_EQ(topology.neighbour[6], kNoTriangle);
  EXPECT_EQ(topology.neighbour[1], kNoTriangle);
  EXPECT_EQ(topology.ring_begin[5], topology.ring_begin[6]);
}

}  // namespace
}  // namespace pleat::test
