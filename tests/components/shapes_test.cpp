#include "components/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/components/skirt.h"

namespace pleat {
namespace {

TEST(Shapes, GridHasTheOrderOfTheWorkloads) {
  constexpr std::uint32_t n = 8;
  const Mesh grid = make_grid({.rows = n, .columns = n});
  ASSERT_EQ(grid.positions.size(), n * n);
  ASSERT_EQ(grid.triangles.size(), 2 * (n - 1) * (n - 1));
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const Vec3 p = grid.positions[i * n + j];
      EXPECT_FLOAT_EQ(p.x, -0.5f + static_cast<float>(j) / (n - 1));
      EXPECT_EQ(p.y, 0.0f);
      EXPECT_FLOAT_EQ(p.z, -0.5f + static_cast<float>(i) / (n - 1));
    }
  }
  for (std::uint32_t i = 0, t = 0; i + 1 < n; ++i) {
    for (std::uint32_t j = 0; j + 1 < n; ++j, t += 2) {
      const std::uint32_t a = i * n + j, b = a + 1, c = a + n, d = c + 1;
      EXPECT_EQ(grid.triangles[t], (Triangle{a, c, d}));
      EXPECT_EQ(grid.triangles[t + 1], (Triangle{a, d, b}));
    }
  }
}

TEST(Shapes, GridHasItsExtentAndFacesUp) {
  for (const bool alternate : {false, true}) {
    const Mesh grid = make_grid({.rows = 3, .columns = 5, .width = 2.0f, .depth = 3.0f, .alternate = alternate});
    EXPECT_EQ(grid.positions.front(), (Vec3{-1.0f, 0.0f, -1.5f}));
    EXPECT_EQ(grid.positions.back(), (Vec3{1.0f, 0.0f, 1.5f}));
    for (const Triangle& t : grid.triangles) {
      const Vec3 a = grid.positions[t[0]];
      EXPECT_GT(cross(grid.positions[t[1]] - a, grid.positions[t[2]] - a).y, 0.0f);
    }
  }
}

TEST(Shapes, AlternatingGridTurnsEveryOtherDiagonal) {
  const Mesh grid = make_grid({.rows = 2, .columns = 3, .alternate = true});
  EXPECT_EQ(grid.triangles, (std::vector<Triangle>{{0, 3, 4}, {0, 4, 1}, {1, 4, 2}, {2, 4, 5}}));
}

TEST(Shapes, SkirtParticlesStandOnTheirRings) {
  const Mesh skirt = make_skirt();
  ASSERT_EQ(skirt.positions.size(), 66u);
  std::size_t index = 0;
  for (std::size_t r = 0; r < 5; ++r) {
    const double radius = 0.14 + 0.0525 * static_cast<double>(r), y = 1.05 - 0.125 * static_cast<double>(r);
    for (std::uint32_t i = 0; i < kSkirtRings[r]; ++i, ++index) {
      const double a = 2.0 * std::numbers::pi * i / kSkirtRings[r];
      EXPECT_NEAR(skirt.positions[index].x, radius * std::sin(a), 1e-7);
      EXPECT_NEAR(skirt.positions[index].y, y, 1e-7);
      EXPECT_NEAR(skirt.positions[index].z, radius * std::cos(a), 1e-7);
    }
  }
}

TEST(Shapes, SkirtStripsFollowTheRuleOfTheWorkloads) {
  std::vector<Triangle> expected;
  std::uint32_t top = 0;
  for (std::size_t r = 0; r + 1 < 5; ++r) {
    const std::uint32_t n = kSkirtRings[r], m = kSkirtRings[r + 1], bottom = top + n;
    std::uint32_t i = 0, j = 0;
    while (i < n || j < m) {
      if (j >= m || (i < n && double{i + 1.0} / n < double{j + 1.0} / m)) {
        expected.push_back({top + i % n, bottom + j % m, top + (i + 1) % n});
        ++i;
      } else {
        expected.push_back({top + i % n, bottom + j % m, bottom + (j + 1) % m});
        ++j;
      }
    }
    top = bottom;
  }
  ASSERT_EQ(expected.size(), 108u);
  EXPECT_EQ(make_skirt().triangles, expected);
}

TEST(Shapes, SkirtFacesOutward) {
  const Mesh skirt = make_skirt();
  for (const Triangle& t : skirt.triangles) {
    const Vec3 a = skirt.positions[t[0]], b = skirt.positions[t[1]], c = skirt.positions[t[2]];
    const Vec3 middle = (a + b + c) * (1.0f / 3.0f);
    EXPECT_GT(dot(cross(b - a, c - a), Vec3{middle.x, 0.0f, middle.z}), 0.0f);
  }
}

}  // namespace
}  // namespace pleat
