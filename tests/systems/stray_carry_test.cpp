#include "systems/stray_carry.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

/// A grid behind a vertex without a triangle, with another one behind it and a third that is a pin.
Mesh grid_with_strays() {
  Mesh mesh = make_grid({.rows = 3, .columns = 3});
  mesh.positions.insert(mesh.positions.begin(), Vec3{50, 0, 0});
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& corner : t) ++corner;
  }
  mesh.positions.push_back({0, -70, 0});
  mesh.positions.push_back({0, 0, 90});
  return mesh;
}

TEST(StrayCarry, RefusesToRunWithAFieldMissing) {
  const Sheet sheet(grid_with_strays());
  const StrayCarry good{&sheet.garment, sheet.position, sheet.velocity};
  ASSERT_TRUE(good.validate());
  StrayCarry bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
}

TEST(StrayCarry, MovesVerticesWithoutATriangleOntoTheMiddleAndLeavesTheRest) {
  const std::uint32_t pins[] = {11};
  const Sheet sheet(grid_with_strays(), pins);
  const Garment& g = sheet.garment;
  ASSERT_EQ(g.strays.size(), 2u);
  EXPECT_EQ(g.strays[0], 0u);
  EXPECT_EQ(g.strays[1], 10u);
  EXPECT_EQ(g.stray_on, 5u) << "the middle of the grid";
  EXPECT_EQ(g.rest_position.view()[0], g.rest_position.view()[5]);
  shake(sheet.velocity, sheet.count, 1.0f, 7);
  std::vector<Vec3> x, v;
  for (std::uint32_t i = 0; i < sheet.count; ++i) x.push_back(sheet.position[i]), v.push_back(sheet.velocity[i]);
  StrayCarry{&g, sheet.position, sheet.velocity}.run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    const std::uint32_t from = i == 0 || i == 10 ? 5 : i;
    EXPECT_EQ(sheet.position[i], x[from]) << i;
    EXPECT_EQ(sheet.velocity[i], v[from]) << i;
  }
}

}  // namespace
}  // namespace pleat
