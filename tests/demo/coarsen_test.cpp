#include "demo/scenes/coarsen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "demo/scenes/cut_to_length.h"

namespace pleat::demo {
namespace {

/// n x n vertices, 1 m wide, flat.
TriangleMesh grid(uint32_t n) {
  TriangleMesh mesh;
  for (uint32_t i = 0; i < n * n; ++i) {
    mesh.positions.insert(mesh.positions.end(), {float(i % n) / float(n - 1), 0.0f, float(i / n) / float(n - 1)});
    if (i % n == n - 1 || i >= n * (n - 1)) continue;
    mesh.triangles.insert(mesh.triangles.end(), {i, i + n, i + 1, i + 1, i + n, i + n + 1});
  }
  return mesh;
}

/// Twice the area seen from above; what faces down counts against it.
double area_from_above(const TriangleMesh& mesh) {
  double area = 0.0;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const float* a = &mesh.positions[3 * mesh.triangles[t]];
    const float* b = &mesh.positions[3 * mesh.triangles[t + 1]];
    const float* c = &mesh.positions[3 * mesh.triangles[t + 2]];
    area += double((b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]));
  }
  return area;
}

TEST(Coarsen, KeepsTheSurfaceAManifoldOfTheSameShape) {
  const TriangleMesh fine = grid(21), coarse = coarsen(fine, 100);
  EXPECT_EQ(coarse.vertex_count(), 100u);
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (size_t t = 0; t < coarse.triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = coarse.triangles[t + k], b = coarse.triangles[t + (k + 1) % 3];
      ASSERT_LT(a, coarse.vertex_count());
      EXPECT_EQ(++edges[std::pair(a, b)], 1) << "two triangles run along an edge the same way";
    }
  }
  size_t undirected = 0;
  for (const auto& [edge, count] : edges)
    undirected += edge.first < edge.second || !edges.contains({edge.second, edge.first});
  EXPECT_EQ(int(coarse.vertex_count()) - int(undirected) + int(coarse.triangle_count()), 1);  // Euler: still a disk
  // No triangle turns over, and of the border only corners are cut.
  EXPECT_NEAR(area_from_above(coarse), area_from_above(fine), 0.1 * area_from_above(fine));
}

TEST(Coarsen, StopsWhereTheSurfaceWouldChangeItsKind) {
  TriangleMesh tetrahedron;
  tetrahedron.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  tetrahedron.triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  EXPECT_EQ(coarsen(tetrahedron, 3).vertex_count(), 4u);
  EXPECT_EQ(coarsen(grid(5), 1000).vertex_count(), 25u);
}

TEST(Coarsen, LeavesATriangleOfEachPiece) {
  TriangleMesh pieces = grid(3);
  pieces.positions.insert(pieces.positions.end(), {9, 9, 9});  // of no triangle
  for (const float x : grid(3).positions) pieces.positions.push_back(x + 5.0f);
  for (const uint32_t v : grid(3).triangles) pieces.triangles.push_back(v + 10);
  const TriangleMesh least = coarsen(pieces, 3);
  EXPECT_EQ(least.triangle_count(), 2u);
  EXPECT_EQ(least.vertex_count(), 6u);
  EXPECT_EQ(coarsen(pieces, 12).vertex_count(), 12u);
}

/// An open tube of radius 0.1 m, 0.3 m long: `around` vertices in each of `rings`.
TriangleMesh tube(uint32_t around, uint32_t rings) {
  TriangleMesh mesh;
  for (uint32_t i = 0; i < around * rings; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % around) / around;
    const float x = float(0.1 * std::cos(angle)), z = float(0.1 * std::sin(angle));
    mesh.positions.insert(mesh.positions.end(), {x, 0.3f * float(i / around) / float(rings - 1), z});
    if (i >= around * (rings - 1)) continue;
    const uint32_t next = i % around == around - 1 ? i + 1 - around : i + 1;
    mesh.triangles.insert(mesh.triangles.end(), {i, i + around, next, next, i + around, next + around});
  }
  return mesh;
}

/// Around both ends, m.
double border_length(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> sides;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) ++sides[std::minmax(mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3])];
  }
  double sum = 0.0;
  for (const auto& [edge, count] : sides) {
    const float *a = &mesh.positions[3 * edge.first], *b = &mesh.positions[3 * edge.second];
    if (count == 1) sum += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  }
  return sum;
}

TEST(CutToLength, GivesAFewChordsTheLengthOfTheClothAlongThem) {
  const TriangleMesh fine = tube(48, 16);
  TriangleMesh coarse = coarsen(fine, 40);
  ASSERT_LT(border_length(coarse), 0.96 * border_length(fine)) << "too fine to tell";
  cut_to_length(fine, coarse);
  EXPECT_NEAR(border_length(coarse), border_length(fine), 0.005 * border_length(fine));
}

TEST(CutToLength, KeepsWhatIsFlatFlatAndOfItsSize) {
  const TriangleMesh fine = grid(21), coarse = coarsen(fine, 100);
  TriangleMesh cut = coarse;
  cut_to_length(fine, cut);
  for (size_t i = 1; i < cut.positions.size(); i += 3) EXPECT_EQ(cut.positions[i], 0.0f) << i;
  EXPECT_NEAR(area_from_above(cut), area_from_above(coarse), 0.01 * area_from_above(coarse));
}

}  // namespace
}  // namespace pleat::demo
