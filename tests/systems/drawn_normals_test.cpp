#include "systems/drawn_normals.h"

#include <gtest/gtest.h>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

TEST(DrawnNormals, UpOnAFlatSheet) {
  for (std::uint32_t level = 0; level <= 8; ++level) {
    Surface s(sheet(4), level);
    s.run();
    for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) {
      EXPECT_LT(length(s.drawn_normal.view()[i] - Vec3{0, 1, 0}), 1e-6f);
    }
  }
}

TEST(DrawnNormals, AreAreaWeightedSumsOverTheDrawnTriangles) {
  for (const std::uint32_t level : {0u, 1u, 4u, 8u}) {
    Surface s(skirt(), level);
    s.jitter(0.01f, 2);
    s.run();
    std::vector<Vec3T<double>> sum(s.pattern.vertex_count);
    const auto at = [&](std::uint32_t i) {
      const Vec3 x = s.drawn.view()[i];
      return Vec3T<double>{x.x, x.y, x.z};
    };
    for (std::size_t t = 0; t < s.pattern.indices.size(); t += 3) {
      const std::uint32_t* i = &s.pattern.indices[t];
      const Vec3T<double> area = cross(at(i[1]) - at(i[0]), at(i[2]) - at(i[0]));
      for (int k = 0; k < 3; ++k) sum[i[k]] += area;
    }
    for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) {
      const Vec3 n = s.drawn_normal.view()[i];
      const Vec3T<double> expected = sum[i] * (1.0 / length(sum[i]));
      EXPECT_LT(length(Vec3T<double>{n.x, n.y, n.z} - expected), 1e-3);
    }
  }
}

TEST(DrawnNormals, PointOutOfTheSkirtAtRest) {
  Surface s(skirt());
  s.run();
  for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) {
    const Vec3 x = s.drawn.view()[i], n = s.drawn_normal.view()[i];
    EXPECT_GT(dot(normalized_or(Vec3{x.x, 0, x.z}, {}), n), 0.8f);
  }
}

TEST(DrawnNormals, FoldedFlatOntoItselfIsFiniteAndUnit) {
  Surface s(sheet(3));
  s.mode = SurfaceMode::kFlat;
  s.move([](const Vec3& x) { return Vec3{std::abs(x.x), 0.0f, x.z}; });  // along the fold the two sides cancel
  s.run();
  for (std::uint32_t i = 0; i < s.pattern.vertex_count; ++i) EXPECT_NEAR(length(s.drawn_normal.view()[i]), 1.0f, 1e-5f);
}

TEST(DrawnNormals, ValidateRefusesWhatIsMissing) {
  Surface s(skirt());
  EXPECT_TRUE(s.drawn_normals().validate());
  DrawnNormals d = s.drawn_normals();
  d.pattern = nullptr;
  EXPECT_FALSE(d.validate());
  d = s.drawn_normals(), d.position = {};
  EXPECT_FALSE(d.validate());
  d = s.drawn_normals(), d.sum = nullptr;
  EXPECT_FALSE(d.validate());
  d = s.drawn_normals(), d.normal = {};
  EXPECT_FALSE(d.validate());
}

}  // namespace
}  // namespace pleat
