#include "components/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "components/shapes.h"

namespace pleat {
namespace {

/// Two triangles over a unit square: the valid thing that each test breaks in one place.
class Square : public testing::Test {
 protected:
  std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
  std::vector<Triangle> triangles{{0, 2, 3}, {0, 3, 1}};

  MeshReport check() { return check_and_repair(positions, triangles); }
};

/// n quads around a strip whose ends are joined after `half_turns` half turns.
Mesh twisted_strip(std::uint32_t n, bool half_turn) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float a = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(n);
    const float t = half_turn ? 0.5f * a : 0.0f;
    for (const float s : {-0.2f, 0.2f}) {
      const float r = 1.0f + s * std::cos(t);
      mesh.positions.push_back({r * std::cos(a), s * std::sin(t), r * std::sin(a)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1;
    std::uint32_t c = 2 * ((i + 1) % n), d = c + 1;
    if (half_turn && i + 1 == n) std::swap(c, d);
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({a, d, c});
  }
  return mesh;
}

TEST_F(Square, IsValidAndLeftAsItIs) {
  const std::vector<Triangle> before = triangles;
  const MeshReport report = check();
  EXPECT_EQ(report.fault, "");
  EXPECT_EQ(triangles, before);
  EXPECT_EQ(report.degenerate_triangles + report.duplicate_triangles + report.flipped_triangles +
                report.unreferenced_vertices + report.nonmanifold_edges + report.nonorientable_edges +
                report.nonmanifold_vertices,
            0u);
  EXPECT_EQ(report.parts, 1u);
  EXPECT_EQ(report.border_loops, 1u);
}

TEST_F(Square, TriangleThatRepeatsACornerIsLeftOut) {
  triangles.push_back({1, 1, 3});
  EXPECT_EQ(check().degenerate_triangles, 1u);
  EXPECT_EQ(triangles.size(), 2u);
}

TEST_F(Square, TriangleWithoutAreaIsLeftOut) {
  positions.push_back({2, 0, 2});  // in line with 0 and 3
  triangles.push_back({0, 3, 4});
  const MeshReport report = check();
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_EQ(report.unreferenced_vertices, 1u);
  EXPECT_EQ(triangles.size(), 2u);
}

TEST_F(Square, TinyTrianglesAreNotDegenerate) {
  for (Vec3& p : positions) p *= 1e-4f;
  EXPECT_EQ(check().fault, "");
  EXPECT_EQ(triangles.size(), 2u);
}

TEST_F(Square, DuplicateIsLeftOutWhateverItsWinding) {
  triangles.push_back({2, 3, 0});
  triangles.push_back({1, 3, 0});
  EXPECT_EQ(check().duplicate_triangles, 2u);
  EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 2, 3}, {0, 3, 1}}));
}

TEST_F(Square, VertexWithoutATriangleIsCounted) {
  positions.push_back({5, 5, 5});
  EXPECT_EQ(check().unreferenced_vertices, 1u);
}

TEST_F(Square, NothingLeftIsAFault) {
  triangles = {{0, 0, 1}};
  EXPECT_EQ(check().fault, "no triangle with an area is left");
}

TEST_F(Square, EdgeWithThreeTrianglesIsRefusedByName) {
  positions.push_back({0.5f, 1, 0.5f});
  triangles.push_back({0, 3, 4});
  const MeshReport report = check();
  EXPECT_EQ(report.nonmanifold_edges, 1u);
  EXPECT_EQ(report.fault, "edge 0-3 has 3 triangles, at most 2 can be cloth");
}

TEST(Mesh, MinorityIsTurned) {
  Mesh mesh = make_grid({.rows = 4, .columns = 4});
  const std::vector<Triangle> good = mesh.triangles;
  for (const std::size_t t : {0u, 7u, 11u}) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const MeshReport report = check_and_repair(mesh.positions, mesh.triangles);
  EXPECT_EQ(report.fault, "");
  EXPECT_EQ(report.flipped_triangles, 3u);
  const auto normal_y = [&](const Triangle& t) {
    return cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]).y;
  };
  for (std::size_t t = 0; t < good.size(); ++t) EXPECT_GT(normal_y(mesh.triangles[t]), 0.0f) << t;
}

TEST(Mesh, MajorityWinsInEachPartByItself) {
  Mesh mesh = make_grid({.rows = 3, .columns = 3});
  const Mesh other = mesh;
  for (const Vec3& p : other.positions) mesh.positions.push_back(p + Vec3{0, 1, 0});
  for (Triangle t : other.triangles) mesh.triangles.push_back({t[0] + 9, t[2] + 9, t[1] + 9});  // faces down
  const MeshReport report = check_and_repair(mesh.positions, mesh.triangles);
  EXPECT_EQ(report.flipped_triangles, 0u);
  EXPECT_EQ(report.parts, 2u);
  EXPECT_EQ(report.border_loops, 2u);
}

TEST(Mesh, MoebiusStripIsRefused) {
  Mesh strip = twisted_strip(12, true);
  const MeshReport report = check_and_repair(strip.positions, strip.triangles);
  EXPECT_EQ(report.nonorientable_edges, 1u);
  EXPECT_NE(report.fault.find("one-sided surface"), std::string::npos) << report.fault;
}

TEST(Mesh, RingHasTwoBorders) {
  Mesh ring = twisted_strip(12, false);
  const MeshReport report = check_and_repair(ring.positions, ring.triangles);
  EXPECT_EQ(report.fault, "");
  EXPECT_EQ(report.parts, 1u);
  EXPECT_EQ(report.border_loops, 2u);
}

TEST(Mesh, ClosedSurfaceHasNoBorder) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const MeshReport report = check_and_repair(positions, triangles);
  EXPECT_EQ(report.fault, "");
  EXPECT_EQ(report.border_loops, 0u);
}

TEST(Mesh, BowTieVertexIsCountedAndAccepted) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {-1, 0, -1}};
  std::vector<Triangle> triangles{{0, 2, 1}, {0, 4, 3}};
  const MeshReport report = check_and_repair(positions, triangles);
  EXPECT_EQ(report.fault, "");
  EXPECT_EQ(report.nonmanifold_vertices, 1u);
  EXPECT_EQ(report.parts, 2u);
}

}  // namespace
}  // namespace pleat
