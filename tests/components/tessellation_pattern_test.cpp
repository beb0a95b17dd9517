#include "components/tessellation_pattern.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

struct Count {
  std::size_t vertices, edges, border, triangles;
};

/// Counts from the index buffer alone; fails on an edge that more than two triangles share or two run the same way.
Count count(const TessellationPattern& p) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
  std::set<std::uint32_t> used(p.indices.begin(), p.indices.end());
  for (std::size_t t = 0; t < p.indices.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++directed[{p.indices[t + k], p.indices[t + (k + 1) % 3]}];
  }
  Count c{used.size(), 0, 0, p.indices.size() / 3};
  for (const auto& [edge, times] : directed) {
    EXPECT_EQ(times, 1);
    EXPECT_NE(edge.first, edge.second);
    const bool open = !directed.contains({edge.second, edge.first});
    c.border += open;
    c.edges += open || edge.first < edge.second;
  }
  return c;
}

TEST(TessellationPattern, FanOnTheSkirtHasThePapersNumbers) {
  const Surface s(skirt());
  ASSERT_EQ(s.garment.particle_count, 66u);
  ASSERT_EQ(s.garment.face_count, 108u);
  const Count c = count(s.pattern);
  EXPECT_EQ(c.triangles, 1944u);
  EXPECT_EQ(c.vertices, 1020u);
  EXPECT_EQ(c.edges, 2964u);
  EXPECT_EQ(c.border, 96u);
  EXPECT_EQ(c.vertices + c.triangles, c.edges);  // an open tube: Euler number 0
  EXPECT_EQ(s.pattern.vertex_count, 1020u);
  EXPECT_EQ(s.pattern.triangle_count, 1944u);
}

TEST(TessellationPattern, UniformLevels) {
  const std::size_t vertices[] = {240, 912, 2016, 3552, 5520, 7920, 10752, 14016};
  for (std::uint32_t level = 1; level <= 8; ++level) {
    const Surface s(skirt(), level);
    const Count c = count(s.pattern);
    EXPECT_EQ(c.vertices, vertices[level - 1]);
    EXPECT_EQ(s.pattern.vertex_count, vertices[level - 1]);
    EXPECT_EQ(c.triangles, 108u * 4 * level * level);
    EXPECT_EQ(c.border, 24u * 2 * level);
    EXPECT_EQ(c.vertices + c.triangles, c.edges);
    EXPECT_LE(s.pattern.vertices_per_face, kMaxVerticesPerFace);
  }
}

TEST(TessellationPattern, BarycentricsLieInTheirPatch) {
  for (std::uint32_t level = 0; level <= 8; ++level) {
    const Surface s(skirt(), level);
    for (const InnerPoint& q : s.pattern.inner) {
      // Each patch's corners in barycentrics of the face.
      const float half = 0.5f;
      const float corner[4][3][3] = {{{1, 0, 0}, {half, half, 0}, {half, 0, half}},
                                     {{0, 1, 0}, {0, half, half}, {half, half, 0}},
                                     {{0, 0, 1}, {half, 0, half}, {0, half, half}},
                                     {{half, half, 0}, {0, half, half}, {half, 0, half}}};
      ASSERT_LT(q.patch, 4u);
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(q.local[k], 0.0f);
        EXPECT_GT(q.face[k], 0.0f);
        float mapped = 0.0f;
        for (int i = 0; i < 3; ++i) mapped += q.local[i] * corner[q.patch][i][k];
        EXPECT_NEAR(mapped, q.face[k], 1e-6f);
      }
    }
  }
}

TEST(TessellationPattern, DrawnTrianglesFaceLikeTheirFaceAndCoverIt) {
  for (std::uint32_t level = 0; level <= 8; ++level) {
    Surface s(sheet(3), level);
    s.mode = SurfaceMode::kFlat;
    s.run();
    const ConstVec3View x = s.drawn.view();
    double area = 0.0;
    for (std::size_t t = 0; t < s.pattern.indices.size(); t += 3) {
      const std::uint32_t* i = &s.pattern.indices[t];
      const float y = cross(x[i[1]] - x[i[0]], x[i[2]] - x[i[0]]).y;
      EXPECT_GT(y, 0.0f);
      area += 0.5 * static_cast<double>(y);
    }
    EXPECT_NEAR(area, 1.0, 1e-5);
  }
}

TEST(TessellationPattern, FacesSideBySideAreTheSameFaces) {
  for (const float crease_angle : {4.0f, 0.5f}) {  // without twins and with them
    const Surface s(garment_of(skirt(), crease_angle), 0);
    const TessellationPattern& p = s.pattern;
    ASSERT_EQ(p.twins.size() != 0, crease_angle < 1.0f);
    for (std::uint32_t begin = 0; begin < s.garment.face_count; begin += kLanes) {
      for (std::uint32_t i = 0; i < kLanes * p.vertices_per_face; ++i) {
        const std::uint32_t face = std::min(begin + i % kLanes, s.garment.face_count - 1);
        const std::size_t row = std::size_t{face} * p.vertices_per_face + i / kLanes;
        EXPECT_EQ(p.drawn_of_faces(begin)[i], p.face_vertices[row]);
        EXPECT_EQ(p.shaded_of_faces(begin)[i], p.shaded_vertices()[row]);
      }
    }
  }
}

}  // namespace
}  // namespace pleat
