#include "systems/edge_ways.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

TEST(EdgeWays, LeadFromEndToEndAndCarryTheirSquare) {
  Sheet sheet(make_grid({.rows = 5, .columns = 4}));
  shake(sheet.previous, sheet.count, 0.5f, 3);
  for (const VectorSet set : {VectorSet::kBaseline, widest_vectors()}) {
    EdgeWays{&sheet.garment, sheet.previous, &sheet.packed, sheet.edge_way.data()}.run(set);
    for (std::uint32_t e = 0; e < sheet.garment.edge_count; ++e) {
      const Vec3 way =
          sheet.previous[sheet.garment.edge_particle[1][e]] - sheet.previous[sheet.garment.edge_particle[0][e]];
      const Vec4& found = sheet.edge_way[e];
      EXPECT_EQ((Vec3{found.x, found.y, found.z}), way);
      EXPECT_EQ(found.w, dot(way, way));
    }
  }
}

TEST(EdgeWays, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const EdgeWays good{&sheet.garment, sheet.previous, &sheet.packed, sheet.edge_way.data()};
  ASSERT_TRUE(good.validate());
  EdgeWays bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.previous = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.packed = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.way = nullptr;
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat
