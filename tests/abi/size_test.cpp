// What a host and a library of different ages know of each other's structs and table.
#include <gtest/gtest.h>

#include <cstddef>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

using Sizes = Host;

/// A table that ends before cloth_bounds, or within it, has what stands before it and nothing from there on.
TEST(Api, HasTellsWhichCallsAnOlderTableHolds) {
  pleat_api older = api();
  EXPECT_TRUE(PLEAT_HAS(&older, world_def_init) && PLEAT_HAS(&older, cloth_bounds));
  for (const std::size_t within : {std::size_t{0}, sizeof older.cloth_bounds - 1}) {
    older.size = static_cast<std::uint32_t>(offsetof(pleat_api, cloth_bounds) + within);
    EXPECT_TRUE(PLEAT_HAS(&older, cloth_teleport));
    EXPECT_FALSE(PLEAT_HAS(&older, cloth_bounds));
    EXPECT_FALSE(PLEAT_HAS(&older, world_keep_budget));
  }
  older.size = offsetof(pleat_api, cloth_bounds) + sizeof older.cloth_bounds;
  EXPECT_TRUE(PLEAT_HAS(&older, cloth_bounds));
}

/// Of a host whose structs end earlier only so much is filled; wrong sizes are refused before anything is made.
TEST_F(Sizes, MeshReportAndGarmentInfoFillAsMuchAsTheHostKnows) {
  pleat_garment_def def = square.def();
  pleat_garment out{7, 7};
  pleat_mesh_report report{};
  report.size = offsetof(pleat_mesh_report, border_loops);
  report.border_loops = 77;
  ASSERT_EQ(api().garment_create(world, &def, &report, &out), pleat_result{PLEAT_OK});
  EXPECT_EQ(report.size, offsetof(pleat_mesh_report, border_loops));
  EXPECT_EQ(report.parts, 1u);
  EXPECT_EQ(report.border_loops, 77u);
  pleat_garment_info info{};
  info.size = offsetof(pleat_garment_info, area);
  info.area = 77.0f;
  ASSERT_EQ(api().garment_info(world, out, &info), pleat_result{PLEAT_OK});
  EXPECT_EQ(info.size, offsetof(pleat_garment_info, area));
  EXPECT_EQ(info.pins, 2u);
  EXPECT_EQ(info.area, 77.0f);

  out = {7, 7};
  for (const std::uint32_t wrong : {0u, 6u, 1000u}) {
    report.size = info.size = wrong;
    expect_refused(PLEAT_ERROR_ARGUMENT, "report.size",
                   [&] { return api().garment_create(world, &def, &report, &out); });
    expect_refused(PLEAT_ERROR_ARGUMENT, "info.size", [&] { return api().garment_info(world, garment, &info); });
  }
  EXPECT_TRUE(out.index == 7 && out.generation == 7);
  expect_refused(PLEAT_ERROR_ARGUMENT, "info is null", [&] { return api().garment_info(world, garment, nullptr); });
}

TEST_F(Sizes, ClothInfoFillsAsMuchAsTheHostKnows) {
  pleat_cloth_info info{};
  info.size = offsetof(pleat_cloth_info, bytes);
  info.bytes = 77;
  ASSERT_EQ(api().cloth_info(world, cloth, &info), pleat_result{PLEAT_OK});
  EXPECT_EQ(info.size, offsetof(pleat_cloth_info, bytes));
  EXPECT_EQ(info.particles, 9u);
  EXPECT_GT(info.substeps, 0u);
  EXPECT_EQ(info.bytes, 77u);
  for (const std::uint32_t wrong : {0u, 7u, static_cast<std::uint32_t>(sizeof info) + 8}) {
    info.size = wrong;
    expect_refused(PLEAT_ERROR_ARGUMENT, "info.size", [&] { return api().cloth_info(world, cloth, &info); });
  }
  expect_refused(PLEAT_ERROR_ARGUMENT, "info is null", [&] { return api().cloth_info(world, cloth, nullptr); });
}

}  // namespace
}  // namespace pleat::abi
