#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

class GarmentDef : public Host {
 protected:
  void refused(pleat_result result, const std::string& field, const std::function<void(pleat_garment_def&)>& spoil) {
    pleat_garment_def def = square.def();
    spoil(def);
    pleat_garment out{7, 7};
    expect_refused(result, field, [&] { return api().garment_create(world, &def, nullptr, &out); });
    EXPECT_TRUE(out.index == 7 && out.generation == 7);
  }
  void bad(const std::string& field, const std::function<void(pleat_garment_def&)>& spoil) {
    refused(PLEAT_ERROR_ARGUMENT, field, spoil);
  }
};

TEST_F(GarmentDef, SquareItselfIsTaken) {
  pleat_garment_def def = square.def();
  pleat_mesh_report report{};
  report.size = sizeof report;
  pleat_garment out{};
  ASSERT_EQ(api().garment_create(world, &def, &report, &out), pleat_result{PLEAT_OK});
  EXPECT_EQ(report.parts, 1u);
  pleat_garment_info info{};
  info.size = sizeof info;
  ASSERT_EQ(api().garment_info(world, out, &info), pleat_result{PLEAT_OK});
  EXPECT_EQ(info.particles, 9u);
  EXPECT_EQ(info.triangles, 8u);
  EXPECT_EQ(info.edges, 16u);
  EXPECT_EQ(info.border_edges, 8u);
  EXPECT_EQ(info.hinges, 8u);
  EXPECT_EQ(info.pins, 2u);
  EXPECT_FLOAT_EQ(info.area, 1.0f);
}

TEST_F(GarmentDef, NullsAreRefusedByName) {
  bad("positions", [](auto& d) { d.positions = nullptr; });
  bad("triangles", [](auto& d) { d.triangles = nullptr; });
  bad("pins", [](auto& d) { d.pins = nullptr; });
  bad("seams", [](auto& d) { d.seams = nullptr; });
  pleat_garment_def def = square.def();
  expect_refused(PLEAT_ERROR_ARGUMENT, "garment", [&] { return api().garment_create(world, &def, nullptr, nullptr); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "def", [&] { return api().garment_create(world, nullptr, nullptr, &garment); });
}

TEST_F(GarmentDef, SizesAndStridesAreChecked) {
  bad("size", [](auto& d) { d.size = 0; });
  bad("size", [](auto& d) { d.size = sizeof d + 1; });
  bad("def.size", [](auto& d) { d.size = offsetof(pleat_garment_def, positions) + 4; });  // half a pointer
  bad("vertex_count", [](auto& d) { d.vertex_count = 2; });
  bad("triangle_count", [](auto& d) { d.triangle_count = 0; });
  bad("positions's stride", [](auto& d) { d.position_stride = 11; });
  bad("uvs's stride", [](auto& d) { d.uv_stride = 7; });
  refused(PLEAT_ERROR_CAPACITY, "vertices", [](auto& d) { d.vertex_count = PLEAT_MAX_PARTICLES + 1; });
  refused(PLEAT_ERROR_CAPACITY, "triangles", [](auto& d) { d.triangle_count = PLEAT_MAX_TRIANGLES + 1; });
  refused(PLEAT_ERROR_CAPACITY, "vertices", [](auto& d) { d.vertex_count = 0xffffffffu; });
}

TEST_F(GarmentDef, ValuesAreChecked) {
  for (const float value : {kNan, kInfinity, -kInfinity, 2e6f}) {
    std::vector<float> positions = square.positions, uvs = square.uvs;
    positions[3 * 4 + 1] = value;
    uvs[2 * 5] = value;
    bad("positions[4][1]", [&](auto& d) { d.positions = positions.data(); });
    bad("uvs[5][0]", [&](auto& d) { d.uvs = uvs.data(); });
  }
}

TEST_F(GarmentDef, IndicesAreChecked) {
  std::vector<std::uint32_t> triangles = square.triangles;
  triangles[3 * 2 + 1] = 9;
  bad("triangles[2][1]", [&](auto& d) { d.triangles = triangles.data(); });
  const std::uint32_t beyond[] = {0, 9}, twice[] = {4, 4};
  bad("pins[1]", [&](auto& d) { d.pins = beyond; });
  bad("pins[1] is 4, a second time", [&](auto& d) { d.pins = twice; });
  bad("seams[0][1]", [&](auto& d) { d.seams = beyond; });
}

TEST_F(GarmentDef, AddedMassIsChecked) {
  for (const float value : {kNan, kInfinity, -1e-3f, 1001.0f}) {
    std::vector<float> masses(9, 0.1f);
    masses[7] = value;
    bad("added_mass[7]", [&](auto& d) { d.added_mass = masses.data(); });
  }
}

TEST_F(GarmentDef, OlderDefWithoutAddedMassIsTaken) {
  pleat_garment_def def = square.def();
  def.size = offsetof(pleat_garment_def, added_mass);
  def.added_mass = reinterpret_cast<const float*>(8);  // beyond what the older host's struct holds
  pleat_garment out{};
  EXPECT_EQ(api().garment_create(world, &def, nullptr, &out), pleat_result{PLEAT_OK});
}

TEST_F(GarmentDef, MeshThatCannotBeClothIsRefusedWithAReport) {
  std::vector<float> positions = square.positions;
  positions.insert(positions.end(), {0, 1, 0});
  std::vector<std::uint32_t> triangles = square.triangles;
  triangles.insert(triangles.end(), {0, 4, 9});  // 0-4 is a diagonal: it has two already
  pleat_garment_def def = square.def();
  def.positions = positions.data();
  def.uvs = nullptr;
  def.vertex_count = 10;
  def.triangles = triangles.data();
  def.triangle_count = 9;
  pleat_mesh_report report{};
  report.size = sizeof report;
  pleat_garment out{};
  expect_refused(PLEAT_ERROR_MESH, "edge 0-4", [&] { return api().garment_create(world, &def, &report, &out); });
  EXPECT_EQ(report.nonmanifold_edges, 1u);
}

TEST_F(GarmentDef, RepairsAreLogged) {
  std::vector<std::uint32_t> triangles = square.triangles;
  triangles.insert(triangles.end(), {0, 0, 1});
  std::swap(triangles[0], triangles[1]);
  pleat_garment_def def = square.def();
  def.triangles = triangles.data();
  def.triangle_count = 9;
  pleat_mesh_report report{};
  report.size = sizeof report;
  pleat_garment out{};
  services.log.clear();
  ASSERT_EQ(api().garment_create(world, &def, &report, &out), pleat_result{PLEAT_OK});
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_EQ(report.flipped_triangles, 1u);
  EXPECT_NE(services.log.find("1 degenerate triangles left out"), std::string::npos) << services.log;
}

TEST_F(GarmentDef, StridedInputIsReadInPlace) {
  std::vector<float> interleaved;
  for (std::size_t i = 0; i < 9; ++i) {
    interleaved.insert(interleaved.end(),
                       {square.positions[3 * i], square.positions[3 * i + 1], square.positions[3 * i + 2], kNan});
  }
  pleat_garment_def def = square.def();
  def.positions = interleaved.data();
  def.position_stride = 16;
  pleat_garment out{};
  ASSERT_EQ(api().garment_create(world, &def, nullptr, &out), pleat_result{PLEAT_OK});
  pleat_garment_info info{};
  info.size = sizeof info;
  ASSERT_EQ(api().garment_info(world, out, &info), pleat_result{PLEAT_OK});
  EXPECT_FLOAT_EQ(info.area, 1.0f);
}

TEST_F(GarmentDef, HandlesThatNameNothingAreRefused) {
  pleat_garment_info info{};
  info.size = sizeof info;
  std::uint32_t indices[64];
  for (const pleat_garment wrong :
       {pleat_garment{0, 0}, pleat_garment{9, 1}, pleat_garment{garment.index, garment.generation + 1}}) {
    expect_refused(PLEAT_ERROR_HANDLE, "garment", [&] { return api().garment_info(world, wrong, &info); });
    expect_refused(PLEAT_ERROR_HANDLE, "garment", [&] { return api().garment_destroy(world, wrong); });
    expect_refused(PLEAT_ERROR_HANDLE, "garment",
                   [&] { return api().garment_read_triangles(world, wrong, indices, 64); });
    expect_refused(PLEAT_ERROR_HANDLE, "garment",
                   [&] { return api().garment_read_edges(world, wrong, indices, nullptr, 32); });
  }
}

TEST_F(GarmentDef, DestroyedTwiceOrWhileWornIsRefused) {
  expect_refused(PLEAT_ERROR_ARGUMENT, "worn", [&] { return api().garment_destroy(world, garment); });
  pleat_garment_def def = square.def();
  pleat_garment spare{};
  ASSERT_EQ(api().garment_create(world, &def, nullptr, &spare), pleat_result{PLEAT_OK});
  ASSERT_EQ(api().garment_destroy(world, spare), pleat_result{PLEAT_OK});
  expect_refused(PLEAT_ERROR_HANDLE, "garment", [&] { return api().garment_destroy(world, spare); });
}

TEST_F(GarmentDef, BuffersThatAreTooSmallAreRefused) {
  std::uint32_t indices[64];
  expect_refused(PLEAT_ERROR_CAPACITY, "capacity",
                 [&] { return api().garment_read_triangles(world, garment, indices, 7); });
  expect_refused(PLEAT_ERROR_CAPACITY, "capacity",
                 [&] { return api().garment_read_edges(world, garment, indices, nullptr, 15); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "triangles",
                 [&] { return api().garment_read_triangles(world, garment, nullptr, 8); });
  ASSERT_EQ(api().garment_read_triangles(world, garment, indices, 8), pleat_result{PLEAT_OK});
  EXPECT_TRUE(std::equal(square.triangles.begin(), square.triangles.end(), indices));
  ASSERT_EQ(api().garment_read_edges(world, garment, indices, nullptr, 16), pleat_result{PLEAT_OK});
  EXPECT_EQ(indices[0], 0u);
  EXPECT_EQ(indices[1], 1u);
}

TEST(ShapeDef, OneBadFieldIsRefused) {
  const std::uint32_t sizes[] = {8, 8}, small[] = {8, 2};
  const float good[] = {1, 1}, wrong[] = {1, kNan};
  const auto refused = [](pleat_result result, const pleat_shape_def& def) {
    std::uint32_t vertices = 77, triangles = 77;
    testing::internal::CaptureStderr();
    EXPECT_EQ(api().shape_size(&def, &vertices, &triangles), result);
    EXPECT_NE(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(vertices, 77u);
  };
  pleat_shape_def def = made(api().shape_def_init);
  def.rows = 1;
  refused(PLEAT_ERROR_ARGUMENT, def);
  def = made(api().shape_def_init), def.width = kInfinity;
  refused(PLEAT_ERROR_ARGUMENT, def);
  def = made(api().shape_def_init), def.kind = 2;
  refused(PLEAT_ERROR_ARGUMENT, def);
  def = made(api().shape_def_init), def.rows = def.columns = 100000;
  refused(PLEAT_ERROR_CAPACITY, def);

  pleat_shape_def rings = made(api().shape_def_init);
  rings.kind = PLEAT_SHAPE_RINGS;
  refused(PLEAT_ERROR_ARGUMENT, rings);
  rings.ring_count = 2, rings.ring_sizes = sizes, rings.ring_radii = good, rings.ring_heights = good;
  std::uint32_t vertices = 0, triangles = 0;
  EXPECT_EQ(api().shape_size(&rings, &vertices, &triangles), pleat_result{PLEAT_OK});
  EXPECT_EQ(vertices, 16u);
  EXPECT_EQ(triangles, 16u);
  def = rings, def.ring_sizes = small;
  refused(PLEAT_ERROR_ARGUMENT, def);
  def = rings, def.ring_radii = wrong;
  refused(PLEAT_ERROR_ARGUMENT, def);
  def = rings, def.ring_heights = wrong;
  refused(PLEAT_ERROR_ARGUMENT, def);
  def = rings, def.ring_heights = nullptr;
  refused(PLEAT_ERROR_ARGUMENT, def);
}

}  // namespace
}  // namespace pleat::abi
