#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

class Cloth : public Host {
 protected:
  pleat_cloth_settings settings() {
    pleat_cloth_settings s{};
    s.size = sizeof s;
    EXPECT_EQ(api().cloth_get(world, cloth, &s), pleat_result{PLEAT_OK});
    return s;
  }
  pleat_cloth_def def() {
    pleat_cloth_def d = made(api().cloth_def_init);
    d.garment = garment;
    return d;
  }
};

TEST_F(Cloth, EachSettingIsRefusedByNameWhereItIsSetAndWhereItIsMade) {
  const auto refused = [&](const char* name, auto field, auto value) {
    pleat_cloth_settings s = settings();
    s.*field = value;
    expect_refused(PLEAT_ERROR_ARGUMENT, name, [&] { return api().cloth_set(world, cloth, &s); });
    pleat_cloth_def d = def();
    d.settings.*field = value;
    pleat_cloth out{};
    expect_refused(PLEAT_ERROR_ARGUMENT, name, [&] { return api().cloth_create(world, &d, &out); });
  };
  using S = pleat_cloth_settings;
  refused("integrator", &S::integrator, 5u);
  refused("substeps", &S::substeps, 65u);
  refused("sweeps", &S::sweeps, 0u);
  refused("sweeps", &S::sweeps, 65u);
  refused("face_response", &S::face_response, 2u);
  refused("surface", &S::surface, 99u);
  refused("level", &S::level, PLEAT_LEVEL_MAX + 1);
  refused("fold_sweeps", &S::fold_sweeps, 65u);
  refused("tangents", &S::tangents, 2u);
  refused("layer", &S::layer, 16u);
  refused("reserved", &S::reserved, 1u);
  const std::pair<const char*, float S::*> floats[] = {{"density", &S::density},
                                                       {"stiffness", &S::stiffness},
                                                       {"stretch_limit", &S::stretch_limit},
                                                       {"bend_stiffness", &S::bend_stiffness},
                                                       {"edge_damping", &S::edge_damping},
                                                       {"bend_damping", &S::bend_damping},
                                                       {"air_damping", &S::air_damping},
                                                       {"drag_coefficient", &S::drag_coefficient},
                                                       {"lift_coefficient", &S::lift_coefficient},
                                                       {"thickness", &S::thickness},
                                                       {"friction", &S::friction},
                                                       {"inner_friction", &S::inner_friction},
                                                       {"self_distance", &S::self_distance},
                                                       {"buckling_strain", &S::buckling_strain},
                                                       {"teleport_speed", &S::teleport_speed},
                                                       {"sleep_speed", &S::sleep_speed}};
  for (const auto& [name, field] : floats) {
    for (const float value : {kNan, kInfinity, -kInfinity, -1e-3f, 1e30f}) refused(name, field, value);
  }
  refused("density", &S::density, 0.0f);
}

TEST_F(Cloth, StructSizesAreChecked) {
  pleat_cloth_settings s = settings();
  for (const std::uint32_t size : {0u, 3u, static_cast<std::uint32_t>(sizeof s) + 1}) {
    s.size = size;
    expect_refused(PLEAT_ERROR_ARGUMENT, "size", [&] { return api().cloth_set(world, cloth, &s); });
    expect_refused(PLEAT_ERROR_ARGUMENT, "size", [&] { return api().cloth_get(world, cloth, &s); });
  }
  pleat_cloth_def d = def();
  pleat_cloth out{};
  for (const std::uint32_t size : {13u, 20u, 117u, static_cast<std::uint32_t>(sizeof d) + 1}) {  // most cut a field
    d.size = size;
    expect_refused(PLEAT_ERROR_ARGUMENT, "def.size is " + std::to_string(size),
                   [&] { return api().cloth_create(world, &d, &out); });
  }
}

TEST_F(Cloth, OlderSmallerStructsWork) {
  pleat_cloth_settings s = settings();
  s.size = offsetof(pleat_cloth_settings, stiffness);
  s.density = 0.5f;
  s.friction = kNan;  // beyond what this host knows
  ASSERT_EQ(api().cloth_set(world, cloth, &s), pleat_result{PLEAT_OK});
  EXPECT_EQ(settings().density, 0.5f);
  EXPECT_EQ(settings().friction, 0.2f);
  ASSERT_EQ(api().cloth_get(world, cloth, &s), pleat_result{PLEAT_OK});
  EXPECT_EQ(s.size, offsetof(pleat_cloth_settings, stiffness));
  EXPECT_TRUE(std::isnan(s.friction));

  pleat_cloth_def d = def();
  d.size = offsetof(pleat_cloth_def, settings);
  d.settings.density = kNan;
  pleat_cloth out{};
  EXPECT_EQ(api().cloth_create(world, &d, &out), pleat_result{PLEAT_OK});
}

/// A host whose pleat_cloth_settings end after `bend_stiffness` hands in the settings of its def, as that was filled.
TEST_F(Cloth, SettingsOfAnOlderSmallerDefSayHowMuchOfThemItHas) {
  constexpr std::size_t kOldSettings = offsetof(pleat_cloth_settings, edge_damping);
  constexpr std::size_t kOldSize = offsetof(pleat_cloth_def, settings) + kOldSettings;
  alignas(pleat_cloth_def) unsigned char memory[sizeof(pleat_cloth_def)];
  std::fill(std::begin(memory), std::end(memory), static_cast<unsigned char>(0xff));  // NaN as a float
  const auto untouched = [&] {
    return std::all_of(memory + kOldSize, std::end(memory), [](unsigned char byte) { return byte == 0xff; });
  };
  auto* old = reinterpret_cast<pleat_cloth_def*>(memory);
  ASSERT_EQ(api().cloth_def_init(old, kOldSize), pleat_result{PLEAT_OK});
  EXPECT_EQ(old->settings.size, kOldSettings);
  EXPECT_TRUE(untouched());
  old->settings.density = 0.5f;
  EXPECT_EQ(api().cloth_set(world, cloth, &old->settings), pleat_result{PLEAT_OK});
  EXPECT_EQ(settings().density, 0.5f);
  EXPECT_EQ(settings().bend_stiffness, 5e-5f);
  EXPECT_EQ(api().cloth_get(world, cloth, &old->settings), pleat_result{PLEAT_OK});
  EXPECT_TRUE(untouched()) << "written beyond the host's struct";
  old->garment = garment;
  pleat_cloth out{};
  EXPECT_EQ(api().cloth_create(world, old, &out), pleat_result{PLEAT_OK});
}

TEST_F(Cloth, ADefWithoutRoomForSettingsHasNoneWritten) {
  for (const std::size_t more : {0u, 1u, 3u, 4u}) {
    const bool whole = more == 0;  // the others are no struct's size
    const std::size_t size = offsetof(pleat_cloth_def, settings) + more;
    alignas(pleat_cloth_def) unsigned char memory[sizeof(pleat_cloth_def)];
    std::fill(std::begin(memory), std::end(memory), static_cast<unsigned char>(0xff));
    ASSERT_EQ(api().cloth_def_init(reinterpret_cast<pleat_cloth_def*>(memory), size),
              pleat_result{whole ? PLEAT_OK : PLEAT_ERROR_ARGUMENT});
    EXPECT_EQ(memory[0] != 0xff, whole);
    EXPECT_TRUE(std::all_of(memory + size, std::end(memory), [](unsigned char byte) { return byte == 0xff; }));
  }
  EXPECT_EQ(def().settings.size, sizeof(pleat_cloth_settings));
}

TEST_F(Cloth, CreateChecksItsInput) {
  pleat_cloth out{};
  pleat_cloth_def d = def();
  expect_refused(PLEAT_ERROR_ARGUMENT, "def", [&] { return api().cloth_create(world, nullptr, &out); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "cloth", [&] { return api().cloth_create(world, &d, nullptr); });
  d.garment.generation += 1;
  expect_refused(PLEAT_ERROR_HANDLE, "garment", [&] { return api().cloth_create(world, &d, &out); });
  std::vector<float> start = square.positions;
  start[5] = kNan;
  d = def(), d.positions = start.data();
  expect_refused(PLEAT_ERROR_ARGUMENT, "positions[1][2]", [&] { return api().cloth_create(world, &d, &out); });
  d.position_stride = 8;
  expect_refused(PLEAT_ERROR_ARGUMENT, "stride", [&] { return api().cloth_create(world, &d, &out); });
}

TEST_F(Cloth, HandlesThatNameNothingAreRefusedEverywhere) {
  pleat_cloth_settings s = settings();
  pleat_cloth_info info{};
  info.size = sizeof info;
  float buffer[512];
  std::uint32_t indices[2048];
  std::uint16_t indices_16[2048];
  std::uint32_t level = 0;
  const pleat_vertex_target target = vertex_target(buffer, 40);
  pleat_cloth_def d = def();
  pleat_cloth gone{};
  ASSERT_EQ(api().cloth_create(world, &d, &gone), pleat_result{PLEAT_OK});
  ASSERT_EQ(api().cloth_destroy(world, gone), pleat_result{PLEAT_OK});
  for (const pleat_cloth bad : {pleat_cloth{0, 0}, pleat_cloth{99, 1}, pleat_cloth{cloth.index, 2}, gone}) {
    const auto refused = [&](auto call) { expect_refused(PLEAT_ERROR_HANDLE, "cloth", call); };
    refused([&] { return api().cloth_destroy(world, bad); });
    refused([&] { return api().cloth_get(world, bad, &s); });
    refused([&] { return api().cloth_set(world, bad, &s); });
    refused([&] { return api().cloth_info(world, bad, &info); });
    refused([&] { return api().cloth_move_pins(world, bad, buffer, 0, 2); });
    refused([&] { return api().cloth_read_particles(world, bad, buffer, nullptr, 9); });
    refused([&] { return api().cloth_write_particles(world, bad, buffer, nullptr, 9); });
    refused([&] { return api().cloth_read_vertices(world, bad, &target); });
    refused([&] { return api().cloth_read_indices(world, bad, indices, 2048); });
    refused([&] { return api().cloth_read_indices_16(world, bad, indices_16, 2048); });
    refused([&] { return api().cloth_suggest_level(world, bad, 100.0f, &level); });
  }
}

TEST_F(Cloth, PinsAndParticlesAreChecked) {
  std::vector<float> x(27, 0.0f), bad(27, 0.0f);
  bad[4] = kNan;
  const auto refused = [&](const char* field, auto call) { expect_refused(PLEAT_ERROR_ARGUMENT, field, call); };
  refused("count", [&] { return api().cloth_move_pins(world, cloth, x.data(), 0, 1); });
  refused("positions", [&] { return api().cloth_move_pins(world, cloth, nullptr, 0, 2); });
  refused("stride", [&] { return api().cloth_move_pins(world, cloth, x.data(), 4, 2); });
  refused("positions[1][1]", [&] { return api().cloth_move_pins(world, cloth, bad.data(), 0, 2); });
  refused("count", [&] { return api().cloth_write_particles(world, cloth, x.data(), nullptr, 8); });
  refused("positions", [&] { return api().cloth_write_particles(world, cloth, nullptr, nullptr, 9); });
  refused("positions[1][1]", [&] { return api().cloth_write_particles(world, cloth, bad.data(), nullptr, 9); });
  refused("velocities[1][1]", [&] { return api().cloth_write_particles(world, cloth, x.data(), bad.data(), 9); });
  std::vector<float> fast(27, 1.1e5f);
  refused("velocities[0][0]", [&] { return api().cloth_write_particles(world, cloth, x.data(), fast.data(), 9); });
  expect_refused(PLEAT_ERROR_CAPACITY, "capacity",
                 [&] { return api().cloth_read_particles(world, cloth, x.data(), nullptr, 8); });
}

TEST_F(Cloth, VertexTargetIsChecked) {
  pleat_cloth_info info{};
  info.size = sizeof info;
  ASSERT_EQ(api().cloth_info(world, cloth, &info), pleat_result{PLEAT_OK});
  std::vector<float> buffer(8 * info.drawn_vertices, -9.0f);
  const pleat_vertex_target good = vertex_target(buffer.data(), info.drawn_vertices);
  const auto refused = [&](pleat_result result, const char* field, const pleat_vertex_target& target) {
    const std::vector<float> before = buffer;
    expect_refused(result, field, [&] { return api().cloth_read_vertices(world, cloth, &target); });
    EXPECT_EQ(buffer, before);
  };
  expect_refused(PLEAT_ERROR_ARGUMENT, "target", [&] { return api().cloth_read_vertices(world, cloth, nullptr); });
  pleat_vertex_target bad = good;
  bad.data = nullptr;
  refused(PLEAT_ERROR_ARGUMENT, "target.data", bad);
  bad = good, bad.capacity -= 1;
  refused(PLEAT_ERROR_CAPACITY, "target.capacity", bad);
  bad = good, bad.stride = 28;
  refused(PLEAT_ERROR_ARGUMENT, "target.uv_offset", bad);
  bad = good, bad.position_offset = 24;
  refused(PLEAT_ERROR_ARGUMENT, "target.position_offset", bad);
  bad = good, bad.size = sizeof bad + 1;
  refused(PLEAT_ERROR_ARGUMENT, "target.size", bad);
  bad = good, bad.stride = 48, bad.tangent_offset = 36;
  refused(PLEAT_ERROR_ARGUMENT, "target.tangent_offset", bad);
  bad = good, bad.stride = 48, bad.tangent_offset = 32;  // the cloth makes none
  if (api().features & PLEAT_FEATURE_SMOOTHING) refused(PLEAT_ERROR_ARGUMENT, "tangents", bad);
  bad = good, bad.size = offsetof(pleat_vertex_target, tangent_offset);  // no struct's size: it cuts a unit of 8 bytes
  refused(PLEAT_ERROR_ARGUMENT, "target.size", bad);
  bad = good, bad.size = offsetof(pleat_vertex_target, position_format), bad.position_format = 99;  // an older host
  EXPECT_EQ(api().cloth_read_vertices(world, cloth, &bad), pleat_result{PLEAT_OK});
  bad = good, bad.normal_offset = 0xfffffff0u;
  refused(PLEAT_ERROR_ARGUMENT, "target.normal_offset", bad);
  ASSERT_EQ(api().cloth_read_vertices(world, cloth, &good), pleat_result{PLEAT_OK});
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(buffer[8 * i + 6], square.uvs[2 * i]);

  bad = good, bad.normal_offset = bad.uv_offset = PLEAT_NO_ATTRIBUTE;
  std::fill(buffer.begin(), buffer.end(), -9.0f);
  ASSERT_EQ(api().cloth_read_vertices(world, cloth, &bad), pleat_result{PLEAT_OK});
  for (std::size_t i = 0; i < buffer.size(); ++i) EXPECT_EQ(buffer[i] == -9.0f, i % 8 >= 3) << i;
}

TEST_F(Cloth, IndicesStayWithinTheDrawnVerticesAtEachLevel) {
  for (std::uint32_t level = 0; level <= PLEAT_LEVEL_MAX; ++level) {
    pleat_cloth_settings s = settings();
    s.level = level;
    ASSERT_EQ(api().cloth_set(world, cloth, &s), pleat_result{PLEAT_OK});
    pleat_cloth_info info{};
    info.size = sizeof info;
    ASSERT_EQ(api().cloth_info(world, cloth, &info), pleat_result{PLEAT_OK});
    if (api().features & PLEAT_FEATURE_SMOOTHING) {
      EXPECT_EQ(info.drawn_triangles, 8 * (level == 0 ? 18 : 4 * level * level));
    }
    std::vector<std::uint32_t> indices(3 * info.drawn_triangles);
    const auto count = static_cast<std::uint32_t>(indices.size());
    expect_refused(PLEAT_ERROR_CAPACITY, "capacity",
                   [&] { return api().cloth_read_indices(world, cloth, indices.data(), count - 1); });
    expect_refused(PLEAT_ERROR_ARGUMENT, "indices",
                   [&] { return api().cloth_read_indices(world, cloth, nullptr, count); });
    ASSERT_EQ(api().cloth_read_indices(world, cloth, indices.data(), count), pleat_result{PLEAT_OK});
    for (const std::uint32_t i : indices) EXPECT_LT(i, info.drawn_vertices);
  }
}

TEST_F(Cloth, SixteenBitIndicesAreTheSameOrRefused) {
  pleat_cloth_info info{};
  info.size = sizeof info;
  ASSERT_EQ(api().cloth_info(world, cloth, &info), pleat_result{PLEAT_OK});
  const std::uint32_t count = 3 * info.drawn_triangles;
  std::vector<std::uint32_t> wide(count);
  std::vector<std::uint16_t> narrow(count);
  ASSERT_EQ(api().cloth_read_indices(world, cloth, wide.data(), count), pleat_result{PLEAT_OK});
  ASSERT_EQ(api().cloth_read_indices_16(world, cloth, narrow.data(), count), pleat_result{PLEAT_OK});
  for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(wide[i], narrow[i]);
  expect_refused(PLEAT_ERROR_CAPACITY, "capacity",
                 [&] { return api().cloth_read_indices_16(world, cloth, narrow.data(), count - 1); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "indices",
                 [&] { return api().cloth_read_indices_16(world, cloth, nullptr, count); });
  if (!(api().features & PLEAT_FEATURE_SMOOTHING)) return;

  // A square of n x n particles has (16 (n - 1) + 1)^2 drawn vertices at level 8: 16 do, 17 are too many.
  for (const std::uint32_t n : {16u, 17u}) {
    pleat_shape_def shape = made(api().shape_def_init);
    shape.rows = shape.columns = n;
    std::vector<float> positions(3 * n * n);
    std::vector<std::uint32_t> triangles(6 * (n - 1) * (n - 1));
    ASSERT_EQ(api().shape_build(&shape, positions.data(), triangles.data()), pleat_result{PLEAT_OK});
    pleat_garment_def garment_def = made(api().garment_def_init);
    garment_def.positions = positions.data(), garment_def.vertex_count = n * n;
    garment_def.triangles = triangles.data();
    garment_def.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
    pleat_cloth_def cloth_def = def();
    ASSERT_EQ(api().garment_create(world, &garment_def, nullptr, &cloth_def.garment), pleat_result{PLEAT_OK});
    cloth_def.settings.level = 8;
    pleat_cloth large{};
    ASSERT_EQ(api().cloth_create(world, &cloth_def, &large), pleat_result{PLEAT_OK});
    ASSERT_EQ(api().cloth_info(world, large, &info), pleat_result{PLEAT_OK});
    EXPECT_EQ(info.drawn_vertices, (16 * n - 15) * (16 * n - 15));
    narrow.resize(3 * info.drawn_triangles);
    const auto read = [&] {
      return api().cloth_read_indices_16(world, large, narrow.data(), static_cast<std::uint32_t>(narrow.size()));
    };
    if (n == 16) {
      EXPECT_EQ(read(), pleat_result{PLEAT_OK});
    } else {
      expect_refused(PLEAT_ERROR_CAPACITY, "66049 drawn vertices", read);
    }
  }
}

TEST_F(Cloth, IndexBuffersAreBuiltOncePerLevel) {
  const auto allocations = [&] {
    pleat_stats stats{};
    stats.size = sizeof stats;
    EXPECT_EQ(api().world_stats(world, &stats), pleat_result{PLEAT_OK});
    return stats.allocations;
  };
  const auto through_all_levels = [&] {
    pleat_cloth_settings s = settings();
    for (std::uint32_t level = 0; level <= PLEAT_LEVEL_MAX; ++level) {
      s.level = level;
      ASSERT_EQ(api().cloth_set(world, cloth, &s), pleat_result{PLEAT_OK});
    }
  };
  through_all_levels();
  const std::uint64_t before = allocations();
  through_all_levels();
  EXPECT_EQ(allocations(), before);
}

TEST_F(Cloth, TangentsAreWrittenWhereAsked) {
  if (!(api().features & PLEAT_FEATURE_SMOOTHING)) GTEST_SKIP() << "smoothing is compiled out";
  pleat_cloth_settings s = settings();
  s.tangents = 1;
  ASSERT_EQ(api().cloth_set(world, cloth, &s), pleat_result{PLEAT_OK});
  pleat_cloth_info info{};
  info.size = sizeof info;
  ASSERT_EQ(api().cloth_info(world, cloth, &info), pleat_result{PLEAT_OK});
  std::vector<float> buffer(12 * info.drawn_vertices);
  pleat_vertex_target target = vertex_target(buffer.data(), info.drawn_vertices);
  target.stride = 48, target.tangent_offset = 32;
  ASSERT_EQ(api().cloth_read_vertices(world, cloth, &target), pleat_result{PLEAT_OK});
  for (std::size_t i = 0; i < info.drawn_vertices; ++i) {
    const float *n = &buffer[12 * i + 3], *t = &buffer[12 * i + 8];
    EXPECT_GT(t[0], 0.9f);  // u runs along x, and the square has hardly moved
    EXPECT_NEAR(t[0] * n[0] + t[1] * n[1] + t[2] * n[2], 0.0f, 1e-5f);
    EXPECT_EQ(t[3], -1.0f);  // u x v = x cross z points down, the normal up
  }
}

TEST_F(Cloth, TeleportChecksItsInput) {
  const float from[3] = {0, 0, 0}, to[3] = {5, 0, 0}, turn[4] = {0, 0.6f, 0, 0.8f}, far[3] = {2e6f, 0, 0};
  const float nan[3] = {0, kNan, 0}, stretched[4] = {0, 0.6f, 0, 1.8f}, nan_turn[4] = {kNan, 0, 0, 1};
  const auto refused = [&](const char* field, const float* a, const float* b, const float* r) {
    expect_refused(PLEAT_ERROR_ARGUMENT, field, [&] { return api().cloth_teleport(world, cloth, a, b, r); });
  };
  refused("from", nullptr, to, turn);
  refused("to", from, nullptr, turn);
  refused("from", nan, to, turn);
  refused("to", from, far, turn);
  refused("rotation", from, to, stretched);
  refused("rotation", from, to, nan_turn);
  const pleat_cloth gone{cloth.index, cloth.generation + 1};
  expect_refused(PLEAT_ERROR_HANDLE, "cloth", [&] { return api().cloth_teleport(world, gone, from, to, turn); });
  ASSERT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
  EXPECT_LT(state()[0], 1.0f) << "a refused jump was made";
  ASSERT_EQ(api().cloth_teleport(world, cloth, from, to, nullptr), pleat_result{PLEAT_OK});
  ASSERT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
  EXPECT_NEAR(state()[0], 4.5f, 1e-3f);
}

TEST_F(Cloth, ImportanceAndBudgetAreChecked) {
  for (const float value : {-1.0f, kNan, kInfinity}) {
    const auto refused = [&](const char* field, auto call) { expect_refused(PLEAT_ERROR_ARGUMENT, field, call); };
    refused("importance", [&] { return api().cloth_set_importance(world, cloth, value); });
    refused("budget_ms", [&] { return api().world_keep_budget(world, value, 1.0f); });
    refused("cost_ms", [&] { return api().world_keep_budget(world, 1.0f, value); });
  }
  const pleat_cloth gone{cloth.index, cloth.generation + 1};
  expect_refused(PLEAT_ERROR_HANDLE, "cloth", [&] { return api().cloth_set_importance(world, gone, 1.0f); });
  EXPECT_EQ(api().cloth_set_importance(world, cloth, 0.0f), pleat_result{PLEAT_OK});
  EXPECT_EQ(api().world_keep_budget(world, 0.0f, 0.0f), pleat_result{PLEAT_OK});
  services.allowed = 0;
  expect_refused(PLEAT_ERROR_MEMORY, "out of memory", [&] { return api().world_keep_budget(world, 1.0f, 5.0f); });
  services.allowed = -1;
  EXPECT_EQ(api().world_keep_budget(world, 1.0f, 5.0f), pleat_result{PLEAT_OK});
}

TEST_F(Cloth, VisibilityIsChecked) {
  const pleat_cloth gone{cloth.index, cloth.generation + 1};
  expect_refused(PLEAT_ERROR_HANDLE, "cloth", [&] { return api().cloth_set_visible(world, gone, 0); });
  EXPECT_EQ(api().cloth_set_visible(nullptr, cloth, 0), pleat_result{PLEAT_ERROR_ARGUMENT});
  ASSERT_EQ(api().cloth_set_visible(world, cloth, 0), pleat_result{PLEAT_OK});
  uint32_t level = 0;
  EXPECT_EQ(api().cloth_suggest_level(world, cloth, 100.0f, &level), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_NE(services.log.find("not visible"), std::string::npos) << services.log;
}

TEST_F(Cloth, SuggestedLevelIsChecked) {
  std::uint32_t level = 99;
  for (const float value : {0.0f, -1.0f, kNan, kInfinity}) {
    expect_refused(PLEAT_ERROR_ARGUMENT, "pixels_per_metre",
                   [&] { return api().cloth_suggest_level(world, cloth, value, &level); });
  }
  expect_refused(PLEAT_ERROR_ARGUMENT, "level",
                 [&] { return api().cloth_suggest_level(world, cloth, 100.0f, nullptr); });
  EXPECT_EQ(level, 99u);
  ASSERT_EQ(api().cloth_suggest_level(world, cloth, 1e-3f, &level), pleat_result{PLEAT_OK});
  EXPECT_EQ(level, 1u);
  pleat_cloth_settings s = settings();
  s.surface = PLEAT_SURFACE_FLAT;
  ASSERT_EQ(api().cloth_set(world, cloth, &s), pleat_result{PLEAT_OK});
  ASSERT_EQ(api().cloth_suggest_level(world, cloth, 1e6f, &level), pleat_result{PLEAT_OK});
  EXPECT_EQ(level, 1u);
}

TEST_F(Cloth, WithoutSmoothingACurvedSurfaceIsNamed) {
  if (api().features & PLEAT_FEATURE_SMOOTHING) GTEST_SKIP() << "smoothing is compiled in";
  pleat_cloth_settings s = settings();
  s.surface = PLEAT_SURFACE_PN;
  expect_refused(PLEAT_ERROR_NOT_COMPILED, "PLEAT_SMOOTHING", [&] { return api().cloth_set(world, cloth, &s); });
}

}  // namespace
}  // namespace pleat::abi
