#include "systems/edge_ways.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

TEST(EdgeWays, LeadFromEndToEnd) {
  Sheet sheet(make_grid({.rows = 5, .columns = 4}));
  shake(sheet.previous, sheet.count, 0.5f, 3);
  const Garment& g = sheet.garment;
  for (const VectorSet set : kVectorSets) {
    if (set > widest_vectors()) continue;
    pack(sheet.previous, nullptr, sheet.count, sheet.packed.previous.data());
    EdgeWays{&g, &sheet.packed.previous, sheet.edge_way.view()}.run(set);
    std::uint32_t edges = 0;
    for (std::uint32_t s = 0; s < g.slots.count; ++s) {
      const std::uint32_t i = g.slots.particle(0, s), j = g.slots.particle(1, s);
      if (i == g.slots.empty_place) continue;
      EXPECT_EQ(sheet.edge_way.view()[s], sheet.previous[j] - sheet.previous[i]);
      ++edges;
    }
    EXPECT_EQ(edges, g.edge_count);
  }
}

TEST(EdgeWays, ThoseOfCoarseLevelsFollow) {
  constexpr std::uint32_t kCorner[] = {0};
  Sheet sheet(make_grid({.rows = 40, .columns = 40}), kCorner);
  shake(sheet.previous, sheet.count, 0.5f, 3);
  const ConstVec3View way = sheet.ways();
  ASSERT_GE(sheet.garment.coarse.size(), 1u);
  for (const CoarseLevel& level : sheet.garment.coarse) {
    for (std::uint32_t s = 0; s < level.slots.count; ++s) {
      const std::uint32_t i = level.slots.particle(0, s), j = level.slots.particle(1, s);
      if (i == level.slots.empty_place) continue;
      EXPECT_EQ(way[level.way_begin + s], sheet.previous[j] - sheet.previous[i]);
    }
  }
}

TEST(EdgeWays, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const EdgeWays good{&sheet.garment, &sheet.packed.previous, sheet.edge_way.view()};
  ASSERT_TRUE(good.validate());
  EdgeWays bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.previous = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.previous = &sheet.packed.force;
  EXPECT_TRUE(bad.validate());
  sheet.packed.force.resize(sheet.count);
  EXPECT_FALSE(bad.validate());
  bad = good, bad.way = {};
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat
