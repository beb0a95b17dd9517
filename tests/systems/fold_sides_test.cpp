#include "systems/fold_sides.h"

#include <gtest/gtest.h>

#include "tests/systems/surface_fixture.h"

namespace pleat {
namespace {

/// A sheet of n x n pushed together along x to `width` of its size, in folds z = height sin(waves pi x) as far as its
/// particles show them.
Surface pushed(std::uint32_t n, float width, float height, float waves) {
  Surface s(sheet(n));
  s.move([&](const Vec3& x) { return Vec3{x.x * width, height * std::sin(waves * 3.14159265f * x.x), x.z}; });
  return s;
}

TEST(FoldSides, NothingShortNothingChosen) {
  Surface s(skirt());
  s.move([](const Vec3& x) { return x * 1.05f; });
  s.run();
  for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
    EXPECT_EQ(s.choices.up[e], 0.0f);
    EXPECT_EQ(s.choices.down[e], 0.0f);
    EXPECT_EQ(s.choices.height[e], 0.0f);
  }
}

TEST(FoldSides, BothFoldsOfAnEdgeHaveTheirSigns) {
  Surface s = pushed(9, 0.9f, 0.05f, 3.0f);
  s.jitter(0.01f, 4);
  s.run();
  for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
    const Vec4& n = s.choices.direction[e];
    EXPECT_GE(s.choices.up[e], 0.0f);
    EXPECT_LE(s.choices.down[e], 0.0f);
    EXPECT_LE(std::abs(s.choices.side[e]), 1.0f);
    EXPECT_NEAR(length(Vec3{n.x, n.y, n.z}), 1.0f, 1e-5f);
    EXPECT_TRUE(s.choices.height[e] >= s.choices.down[e] && s.choices.height[e] <= s.choices.up[e]);
  }
}

TEST(FoldSides, ARidgeRunsOnWhereItsBulgeIsUnclear) {
  // A column of quads is pushed together; all but the edges of the middle row are shown their side by the normals.
  // The threads across are not short, so a middle that went to the other side would stretch the cloth in between.
  Surface s = pushed(9, 0.93f, 0.0f, 0.0f);
  s.particle_normals().run();
  const Garment& g = s.garment;
  const auto along_x = [&](std::uint32_t e) { return g.edge_particle[1][e] == g.edge_particle[0][e] + 1; };
  const auto row = [&](std::uint32_t e) { return g.edge_particle[0][e] / 9; };
  const auto column = [&](std::uint32_t e) { return g.edge_particle[0][e] % 9; };
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (i / 9 == 4) continue;
    const float tilt = (i % 9 % 2 == 0 ? -0.15f : 0.15f);  // columns of folds, up and down in turn
    s.normal.view().set(i, normalized_or(Vec3{tilt, 1.0f, 0.0f}, {}));
  }
  s.fold_sides().run();
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    if (!along_x(e) || row(e) == 0 || row(e) == 8) continue;
    EXPECT_GT(s.choices.side[e] * (column(e) % 2 == 0 ? 1.0f : -1.0f), row(e) == 4 ? 0.5f : 0.9f) << e;
  }
}

TEST(FoldSides, MirroredClothChoosesMirroredSides) {
  Surface a = pushed(9, 0.85f, 0.06f, 3.0f);
  a.jitter(0.005f, 5);
  Surface b(sheet(9));
  std::uint32_t i = 0;
  b.move([&](const Vec3&) {
    const Vec3 x = a.position.view()[i++];
    return Vec3{x.x, -x.y, x.z};
  });
  a.run(), b.run();
  for (std::uint32_t e = 0; e < a.garment.edge_count; ++e) {
    EXPECT_NEAR(a.choices.side[e], -b.choices.side[e], 1e-3f);
  }
}

TEST(FoldSides, SmoothInThePositions) {
  Surface s = pushed(9, 0.85f, 0.04f, 3.0f);
  s.jitter(0.005f, 6);
  const std::uint32_t moved = 40;
  const Vec3 start = s.position.view()[moved];
  std::vector<float> last;
  for (int step = 0; step <= 400; ++step) {
    s.position.view().set(moved, start + Vec3{0.0f, 1e-4f * static_cast<float>(step), 0.0f});
    if (step > 0) s.follow(s, 1e-3f);
    s.run();
    for (std::uint32_t e = 0; e < s.garment.edge_count && step > 0; ++e) {
      EXPECT_NEAR(s.fold_height[e], last[e], 4e-3f) << e << " at " << step;
    }
    last.assign(s.fold_height.begin(), s.fold_height.end());
  }
}

TEST(FoldSides, FollowsItsChoiceInTime) {
  Surface s = pushed(9, 0.85f, 0.04f, 3.0f), later = pushed(9, 0.85f, 0.04f, 3.0f);
  s.run();
  std::ranges::fill(later.fold_side, 1.0f);
  later.kept = 0.75f;
  later.run();
  for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
    EXPECT_NEAR(later.fold_side[e], 0.75f + 0.25f * s.fold_side[e], 1e-6f) << e;
  }
}

TEST(FoldSides, DegenerateClothStaysFinite) {
  for (const float scale : {0.0f, 1e-12f, 1e-4f}) {
    Surface s(skirt());
    s.move([&](const Vec3& x) { return Vec3{x.x * scale, x.y * scale, 0.0f}; });
    s.run();
    for (std::uint32_t e = 0; e < s.garment.edge_count; ++e) {
      EXPECT_TRUE(std::isfinite(s.choices.side[e]));
      EXPECT_TRUE(std::isfinite(s.choices.height[e]));
    }
  }
}

TEST(FoldSides, ValidateRefusesWhatIsMissing) {
  Surface s(skirt());
  EXPECT_TRUE(s.fold_sides().validate());
  FoldSides f = s.fold_sides();
  f.garment = nullptr;
  EXPECT_FALSE(f.validate());
  f = s.fold_sides(), f.position = {};
  EXPECT_FALSE(f.validate());
  f = s.fold_sides(), f.normal = {};
  EXPECT_FALSE(f.validate());
  f = s.fold_sides(), f.choices = nullptr;
  EXPECT_FALSE(f.validate());
  f = s.fold_sides(), f.side = nullptr;
  EXPECT_FALSE(f.validate());
  FoldChoices none(std::pmr::get_default_resource());
  f = s.fold_sides(), f.choices = &none;
  EXPECT_FALSE(f.validate());
}

}  // namespace
}  // namespace pleat
