#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

TEST(Api, IsCompleteAndSpeaksItsMajorOnly) {
  EXPECT_EQ(pleat_get_api(0), nullptr);
  EXPECT_EQ(pleat_get_api(PLEAT_API_MAJOR + 1), nullptr);
  const pleat_api& table = api();
  EXPECT_EQ(table.size, sizeof(pleat_api));
  EXPECT_EQ(table.major, PLEAT_API_MAJOR);
  EXPECT_STREQ(table.version, PLEAT_VERSION_STRING);
  EXPECT_EQ(table.features & ~std::uint32_t{PLEAT_FEATURE_COLLISION | PLEAT_FEATURE_SMOOTHING}, 0u);
  const auto* entry = reinterpret_cast<void* const*>(&table.world_def_init);
  const auto* end = reinterpret_cast<void* const*>(&table + 1);
  for (; entry != end; ++entry) EXPECT_NE(*entry, nullptr);
}

/// world_create has no log of a world yet: the line goes to stderr.
void expect_world_refused(const std::string& field, const std::function<void(pleat_world_def&)>& spoil) {
  pleat_world_def def = made(api().world_def_init);
  spoil(def);
  pleat_world* world = nullptr;
  testing::internal::CaptureStderr();
  EXPECT_EQ(api().world_create(&def, &world), pleat_result{PLEAT_ERROR_ARGUMENT}) << field;
  EXPECT_NE(testing::internal::GetCapturedStderr().find(field), std::string::npos) << field;
  EXPECT_EQ(world, nullptr);
}

TEST(WorldDef, OneBadFieldIsRefusedByName) {
  for (const float bad : {kNan, kInfinity, -2e4f}) {
    expect_world_refused("gravity", [&](pleat_world_def& d) { d.gravity[1] = bad; });
    expect_world_refused("wind", [&](pleat_world_def& d) { d.wind[2] = bad; });
    expect_world_refused("air_density", [&](pleat_world_def& d) { d.air_density = bad; });
    expect_world_refused("max_substep", [&](pleat_world_def& d) { d.max_substep = bad; });
    expect_world_refused("gust", [&](pleat_world_def& d) { d.gust = bad; });
    expect_world_refused("gust_frequency", [&](pleat_world_def& d) { d.gust_frequency = bad; });
  }
  expect_world_refused("max_substep", [](pleat_world_def& d) { d.max_substep = 0.0f; });
  expect_world_refused("workers", [](pleat_world_def& d) { d.workers = 0; });
  expect_world_refused("workers", [](pleat_world_def& d) { d.workers = PLEAT_MAX_WORKERS + 1; });
  expect_world_refused("size", [](pleat_world_def& d) { d.size = 0; });
  expect_world_refused("size", [](pleat_world_def& d) { d.size += 8; });
  expect_world_refused("allocate", [](pleat_world_def& d) { d.allocate = &Services::allocate; });
  expect_world_refused("free", [](pleat_world_def& d) { d.free = &Services::release; });
}

TEST(WorldDef, NullsAreRefused) {
  testing::internal::CaptureStderr();
  pleat_world_def def = made(api().world_def_init);
  pleat_world* world = nullptr;
  EXPECT_EQ(api().world_create(nullptr, &world), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(api().world_create(&def, nullptr), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(api().world_step(nullptr, 0.1f), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(api().world_def_init(nullptr, sizeof def), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(api().world_def_init(&def, 0), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(api().world_def_init(&def, sizeof def + 1), pleat_result{PLEAT_ERROR_ARGUMENT});
  api().world_destroy(nullptr);
  testing::internal::GetCapturedStderr();
}

TEST(WorldDef, OlderSmallerStructWorks) {
  // A host built when pleat_world_def ended after `air_density`.
  constexpr std::size_t kOldSize = offsetof(pleat_world_def, max_substep);
  alignas(pleat_world_def) unsigned char memory[sizeof(pleat_world_def)];
  std::fill(std::begin(memory), std::end(memory), static_cast<unsigned char>(0xff));
  auto* def = reinterpret_cast<pleat_world_def*>(memory);
  ASSERT_EQ(api().world_def_init(def, kOldSize), pleat_result{PLEAT_OK});
  EXPECT_EQ(def->size, kOldSize);
  for (std::size_t i = kOldSize; i < sizeof memory; ++i)
    EXPECT_EQ(memory[i], 0xff) << "written beyond the host's struct";
  pleat_world* world = nullptr;
  ASSERT_EQ(api().world_create(def, &world), pleat_result{PLEAT_OK});
  EXPECT_EQ(api().world_step(world, 0.1f), pleat_result{PLEAT_OK});
  api().world_destroy(world);
}

TEST_F(Host, StepTakesSaneTimesOnly) {
  for (const float dt : {-0.1f, 5e-7f, 1.1f, kNan, kInfinity}) {
    expect_refused(PLEAT_ERROR_ARGUMENT, "dt", [&] { return api().world_step(world, dt); });
  }
  EXPECT_EQ(api().world_step(world, 1.0f), pleat_result{PLEAT_OK});
  EXPECT_EQ(api().world_step(world, 1e-6f), pleat_result{PLEAT_OK});
}

TEST_F(Host, APausedStepDoesNothing) {
  pleat_stats before{}, after{};
  before.size = after.size = sizeof before;
  ASSERT_EQ(api().world_stats(world, &before), pleat_result{PLEAT_OK});
  EXPECT_EQ(api().world_step(world, 0.0f), pleat_result{PLEAT_OK});
  ASSERT_EQ(api().world_stats(world, &after), pleat_result{PLEAT_OK});
  EXPECT_EQ(std::memcmp(&before, &after, sizeof before), 0);
}

TEST_F(Host, ADefThatIsRefusedIsLoggedWhereItSays) {
  std::vector<std::string> lines;
  pleat_world_def def;
  ASSERT_EQ(api().world_def_init(&def, sizeof def), pleat_result{PLEAT_OK});
  def.log = [](std::uint32_t, const char* line, void* user) {
    static_cast<std::vector<std::string>*>(user)->push_back(line);
  };
  def.log_user = &lines;
  def.gravity[0] = kNan;
  pleat_world* none = nullptr;
  EXPECT_EQ(api().world_create(&def, &none), pleat_result{PLEAT_ERROR_ARGUMENT});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("world_create: gravity[0]"), std::string::npos) << lines[0];
}

TEST_F(Host, GravityAndWindAreChecked) {
  for (const float bad : {kNan, kInfinity, 2e4f}) {
    const float v[3] = {0, bad, 0};
    expect_refused(PLEAT_ERROR_ARGUMENT, "gravity", [&] { return api().world_set_gravity(world, v); });
    expect_refused(PLEAT_ERROR_ARGUMENT, "wind", [&] { return api().world_set_wind(world, v); });
  }
  expect_refused(PLEAT_ERROR_ARGUMENT, "gravity", [&] { return api().world_set_gravity(world, nullptr); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "wind", [&] { return api().world_set_wind(world, nullptr); });
}

TEST_F(Host, GustsAreChecked) {
  for (const float bad : {kNan, kInfinity, -1.0f, 2e3f}) {
    expect_refused(PLEAT_ERROR_ARGUMENT, "gust", [&] { return api().world_set_gust(world, bad, 1.0f, 0); });
    expect_refused(PLEAT_ERROR_ARGUMENT, "gust_frequency", [&] { return api().world_set_gust(world, 1.0f, bad, 0); });
  }
  EXPECT_EQ(api().world_set_gust(world, 1.0f, 1.0f, 7), pleat_result{PLEAT_OK});
}

TEST_F(Host, StatsFillAsMuchAsTheHostKnows) {
  pleat_stats stats{};
  stats.size = sizeof stats;
  ASSERT_EQ(api().world_stats(world, &stats), pleat_result{PLEAT_OK});
  EXPECT_EQ(stats.ticks, 1u);
  EXPECT_GT(stats.allocations, 0u);
  EXPECT_GE(stats.peak_bytes, stats.bytes);
  pleat_stats old{};
  old.size = offsetof(pleat_stats, particle_contacts);
  old.bytes = 77;
  ASSERT_EQ(api().world_stats(world, &old), pleat_result{PLEAT_OK});
  EXPECT_EQ(old.substeps, stats.substeps);
  EXPECT_EQ(old.bytes, 77u);
  old.size = sizeof(pleat_stats) + 1;
  expect_refused(PLEAT_ERROR_ARGUMENT, "stats.size", [&] { return api().world_stats(world, &old); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "stats", [&] { return api().world_stats(world, nullptr); });
}

TEST_F(Host, CallbacksMustBeGiven) {
  expect_refused(PLEAT_ERROR_ARGUMENT, "write", [&] { return api().world_explain(world, nullptr, nullptr); });
  expect_refused(PLEAT_ERROR_ARGUMENT, "draw", [&] { return api().world_debug_draw(world, ~0u, nullptr, nullptr); });
}

TEST_F(Host, DebugDrawShowsFiniteLinesOfEachKind) {
  struct Count {
    std::uint32_t lines = 0;
    static void line(const float from[3], const float to[3], std::uint32_t, void* user) {
      ++static_cast<Count*>(user)->lines;
      for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(from[k]) && std::isfinite(to[k]));
    }
  };
  const auto count = [&](std::uint32_t what) {
    Count lines;
    EXPECT_EQ(api().world_debug_draw(world, what, &Count::line, &lines), pleat_result{PLEAT_OK});
    return lines.lines;
  };
  EXPECT_EQ(count(0), 0u);
  EXPECT_EQ(count(PLEAT_DEBUG_COARSE_EDGES), 16u);
  if (api().features & PLEAT_FEATURE_SMOOTHING) {
    EXPECT_EQ(count(PLEAT_DEBUG_BASE_NORMALS), 9u);
    EXPECT_EQ(count(PLEAT_DEBUG_FORCE_NORMALS), 9u);
  }
  EXPECT_GE(count(~0u), 16u);
}

}  // namespace
}  // namespace pleat::abi
