// The host's allocator says no at every possible moment: the call fails, nothing leaks, the world goes on.
#include <gtest/gtest.h>

#include <functional>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

class Memory : public Host {
 protected:
  std::vector<char> saved() {
    std::uint64_t bytes = 0;
    EXPECT_EQ(api().world_state_size(world, &bytes), pleat_result{PLEAT_OK});
    std::vector<char> to(bytes);
    EXPECT_EQ(api().world_save(world, to.data(), bytes), pleat_result{PLEAT_OK});
    return to;
  }
  /// Runs `call` with 0, 1, 2 ... allocations allowed until it succeeds; returns how many it took.
  long fail_until_done(const std::function<pleat_result()>& call) {
    for (long n = 0; n < 1000; ++n) {
      const std::vector<float> before = state();
      const std::vector<char> saved_before = saved();
      services.allowed = n;
      services.log.clear();
      const pleat_result result = call();
      services.allowed = -1;
      if (result == PLEAT_OK) return n;
      EXPECT_EQ(result, pleat_result{PLEAT_ERROR_MEMORY}) << n;
      EXPECT_NE(services.log.find("out of memory"), std::string::npos);
      EXPECT_EQ(state(), before) << n;
      EXPECT_EQ(saved(), saved_before) << n;
      EXPECT_EQ(api().world_step(world, 1e-4f), pleat_result{PLEAT_OK});
    }
    ADD_FAILURE() << "never succeeds";
    return -1;
  }
};

TEST(MemoryOfAWorld, RunsOutInWorldCreate) {
  long n = 0;
  for (;; ++n) {
    Services services;
    services.allowed = n;
    pleat_world_def def = made(api().world_def_init);
    def.allocate = &Services::allocate;
    def.free = &Services::release;
    def.memory_user = &services;
    pleat_world* world = nullptr;
    testing::internal::CaptureStderr();
    const pleat_result result = api().world_create(&def, &world);
    const std::string log = testing::internal::GetCapturedStderr();
    if (result == PLEAT_OK) {
      api().world_destroy(world);
      EXPECT_EQ(services.bytes, 0u);
      break;
    }
    EXPECT_EQ(result, pleat_result{PLEAT_ERROR_MEMORY});
    EXPECT_NE(log.find("out of memory"), std::string::npos);
    EXPECT_EQ(world, nullptr);
    EXPECT_EQ(services.bytes, 0u) << "leaked after " << n << " allocations";
  }
  EXPECT_GE(n, 1);
}

TEST_F(Memory, RunsOutInGarmentCreate) {
  pleat_garment_def def = square.def();
  pleat_garment out{};
  EXPECT_GT(fail_until_done([&] { return api().garment_create(world, &def, nullptr, &out); }), 20);
  EXPECT_EQ(api().garment_destroy(world, out), pleat_result{PLEAT_OK});
}

TEST_F(Memory, RunsOutInClothCreate) {
  for (std::uint32_t level = 0; level < 3; ++level) {
    pleat_cloth_def def = made(api().cloth_def_init);
    def.garment = garment;
    def.settings.level = level;
    def.settings.integrator = PLEAT_INTEGRATOR_RUNGE_KUTTA_4;
    pleat_cloth out{};
    EXPECT_GE(fail_until_done([&] { return api().cloth_create(world, &def, &out); }), 0);
    EXPECT_EQ(api().world_step(world, 0.01f), pleat_result{PLEAT_OK});
    EXPECT_EQ(api().cloth_destroy(world, out), pleat_result{PLEAT_OK});
  }
}

TEST_F(Memory, RunsOutInTheFirstCurvedClothOfAWorld) {
  if (!(api().features & PLEAT_FEATURE_SMOOTHING)) GTEST_SKIP() << "smoothing is compiled out";
  ASSERT_EQ(api().cloth_destroy(world, cloth), pleat_result{PLEAT_OK});
  api().world_destroy(world);
  pleat_world_def world_def = made(api().world_def_init);
  world_def.log = &Services::write;
  world_def.log_user = world_def.memory_user = &services;
  world_def.allocate = &Services::allocate;
  world_def.free = &Services::release;
  ASSERT_EQ(api().world_create(&world_def, &world), pleat_result{PLEAT_OK});
  pleat_garment_def garment_def = square.def();
  ASSERT_EQ(api().garment_create(world, &garment_def, nullptr, &garment), pleat_result{PLEAT_OK});
  pleat_cloth_def def = made(api().cloth_def_init);
  def.garment = garment;
  def.settings.surface = PLEAT_SURFACE_FLAT;
  ASSERT_EQ(api().cloth_create(world, &def, &cloth), pleat_result{PLEAT_OK});
  def.settings.surface = PLEAT_SURFACE_PLEAT;
  pleat_cloth out{};
  EXPECT_GT(fail_until_done([&] { return api().cloth_create(world, &def, &out); }), 5);
}

TEST_F(Memory, RunsOutInClothSet) {
  pleat_cloth_settings s{};
  s.size = sizeof s;
  ASSERT_EQ(api().cloth_get(world, cloth, &s), pleat_result{PLEAT_OK});
  s.level = 5;
  s.integrator = PLEAT_INTEGRATOR_RUNGE_KUTTA_4;
  EXPECT_GT(fail_until_done([&] { return api().cloth_set(world, cloth, &s); }), 3);
  const bool collides = (api().features & PLEAT_FEATURE_COLLISION) != 0;
  s.level = 3, s.layer = collides ? 2 : 0, s.inner_friction = 0.0f;
  s.tangents = (api().features & PLEAT_FEATURE_SMOOTHING) != 0 ? 1 : 0;
  EXPECT_GE(fail_until_done([&] { return api().cloth_set(world, cloth, &s); }), collides ? 1 : 0);
}

TEST_F(Memory, RunsOutInColliderCreate) {
  if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "collision is compiled out";
  pleat_collider_def capsule = made(api().collider_def_init);
  capsule.radius = 0.1f, capsule.a[1] = capsule.b[1] = -2.0f;
  pleat_collider out{};
  EXPECT_GT(fail_until_done([&] { return api().collider_create(world, &capsule, &out); }), 5);
  const float corners[12] = {0, -1, 0, 1, -1, 0, 0, -1, 1, 0, -0.5f, 0};
  const std::uint32_t faces[12] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
  pleat_collider_def mesh = made(api().collider_def_init);
  mesh.shape = PLEAT_COLLIDER_MESH;
  mesh.positions = corners;
  mesh.vertex_count = 4;
  mesh.triangles = faces;
  mesh.triangle_count = 4;
  pleat_collider body{};
  EXPECT_GT(fail_until_done([&] { return api().collider_create(world, &mesh, &body); }), 5);
  EXPECT_EQ(api().world_step(world, 0.01f), pleat_result{PLEAT_OK});
  EXPECT_EQ(api().collider_destroy(world, body), pleat_result{PLEAT_OK});
  EXPECT_EQ(api().collider_destroy(world, out), pleat_result{PLEAT_OK});
}

}  // namespace
}  // namespace pleat::abi
