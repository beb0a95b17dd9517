#include "systems/point_grid.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace pleat {
namespace {

struct Points {
  Vec3Column column{std::pmr::new_delete_resource()};
  GridScratch scratch{std::pmr::new_delete_resource()};

  explicit Points(std::size_t count) {
    column.resize(count);
    scratch.make_room(count);
  }
  PointGrid grid(float cell) { return {column.view(), static_cast<std::uint32_t>(column.size()), cell, scratch}; }
};

TEST(PointGrid, PropertyEveryPointInABoxIsVisitedOnce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1.0f, 1.0f);
  for (const float cell : {0.0f, 1e-6f, 0.05f, 0.3f, 100.0f}) {
    for (const float flat : {1.0f, 0.0f}) {  // in space, and all in a plane
      Points points(200);
      for (std::size_t i = 0; i < 200; ++i)
        points.column.view().set(i, {place(random), flat * place(random), place(random)});
      const PointGrid grid = points.grid(cell);
      for (int trial = 0; trial < 50; ++trial) {
        Box box;
        box.include({place(random), place(random), place(random)});
        box = box.grown(0.4f);
        std::vector<int> visits(200);
        grid.for_each_near(box, [&](std::uint32_t i) { ++visits[i]; });
        for (std::size_t i = 0; i < 200; ++i) {
          const Vec3 p = points.column.view()[i];
          EXPECT_LE(visits[i], 1);
          EXPECT_TRUE(visits[i] == 1 || !box.overlaps({p, p})) << i;
        }
      }
    }
  }
}

TEST(PointGrid, PointsThatAreNotFiniteHarmNothing) {
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3& bad : {Vec3{kInf, 0, 0}, Vec3{0, -kInf, 0}, Vec3{0, 0, kNan}, Vec3{1e38f, -1e38f, kInf}}) {
    Points points(5);
    points.column.view().set(2, bad);
    int visits = 0;
    const PointGrid grid = points.grid(0.1f);
    grid.for_each_near(Box{{-1, -1, -1}, {1, 1, 1}}, [&](std::uint32_t) { ++visits; });
    grid.for_each_near(Box{bad, bad}, [&](std::uint32_t) {});
    EXPECT_LE(visits, 5);
  }
}

}  // namespace
}  // namespace pleat
