#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>

#include "tests/abi/host.h"

namespace pleat::abi {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

class Collider : public Host {
 protected:
  const float corners[12] = {0, -1, 0, 1, -1, 0, 0, -1, 1, 0, -0.5f, 0};
  const std::uint32_t faces[12] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};

  void SetUp() override {
    if (!(api().features & PLEAT_FEATURE_COLLISION)) GTEST_SKIP() << "collision is compiled out";
  }
  pleat_collider_def capsule() {
    pleat_collider_def def = made(api().collider_def_init);
    def.a[1] = -2.0f, def.b[1] = -3.0f, def.radius = 0.1f;
    return def;
  }
  pleat_collider_def mesh() {
    pleat_collider_def def = made(api().collider_def_init);
    def.shape = PLEAT_COLLIDER_MESH;
    def.positions = corners;
    def.vertex_count = 4;
    def.triangles = faces;
    def.triangle_count = 4;
    return def;
  }
  pleat_collider create(const pleat_collider_def& def) {
    pleat_collider out{};
    EXPECT_EQ(api().collider_create(world, &def, &out), pleat_result{PLEAT_OK}) << services.log;
    return out;
  }
  void bad(const std::string& field, pleat_collider_def def, const std::function<void(pleat_collider_def&)>& spoil) {
    spoil(def);
    pleat_collider out{7, 7};
    expect_refused(PLEAT_ERROR_ARGUMENT, field, [&] { return api().collider_create(world, &def, &out); });
    EXPECT_EQ(out.index, 7u);
  }
};

TEST_F(Collider, OneBadFieldIsRefusedByName) {
  for (const float value : {kNan, kInfinity, -2e6f}) {
    bad("a", capsule(), [&](auto& d) { d.a[0] = value; });
    bad("b", capsule(), [&](auto& d) { d.b[2] = value; });
    bad("radius", capsule(), [&](auto& d) { d.radius = value; });
    bad("friction", capsule(), [&](auto& d) { d.friction = value; });
    float moved[12];
    std::copy(std::begin(corners), std::end(corners), moved);
    moved[7] = value;
    bad("positions[2][1]", mesh(), [&](auto& d) { d.positions = moved; });
  }
  bad("size", capsule(), [](auto& d) { d.size = 2; });
  bad("shape", capsule(), [](auto& d) { d.shape = 2; });
  bad("positions", mesh(), [](auto& d) { d.positions = nullptr; });
  bad("stride", mesh(), [](auto& d) { d.position_stride = 8; });
  bad("vertex_count", mesh(), [](auto& d) { d.vertex_count = 2; });
  bad("triangles", mesh(), [](auto& d) { d.triangles = nullptr; });
  bad("triangle_count", mesh(), [](auto& d) { d.triangle_count = 0; });
  bad("triangle_count", mesh(), [](auto& d) { d.triangle_count = 0xffffffffu; });
  bad("triangles[1][1]", mesh(), [](auto& d) { d.vertex_count = 3; });
  pleat_collider_def def = capsule();
  expect_refused(PLEAT_ERROR_ARGUMENT, "collider", [&] { return api().collider_create(world, &def, nullptr); });
}

TEST_F(Collider, OlderSmallerStructWorks) {
  pleat_collider_def def = capsule();
  def.size = offsetof(pleat_collider_def, positions);
  def.friction = kNan;
  create(def);
  EXPECT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
}

TEST_F(Collider, MovesAreChecked) {
  const pleat_collider a = create(capsule()), b = create(mesh());
  const float good[3] = {0, -2, 0}, wrong[3] = {0, kNan, 0};
  float vertices[12] = {};
  vertices[5] = kInfinity;
  const auto refused = [&](const char* field, auto call) { expect_refused(PLEAT_ERROR_ARGUMENT, field, call); };
  refused("a[1]", [&] { return api().collider_move_capsule(world, a, wrong, good); });
  refused("b[1]", [&] { return api().collider_move_capsule(world, a, good, wrong); });
  refused("a", [&] { return api().collider_move_capsule(world, a, nullptr, good); });
  refused("not a capsule", [&] { return api().collider_move_capsule(world, b, good, good); });
  refused("not a mesh", [&] { return api().collider_move_mesh(world, a, corners, 0, 4); });
  refused("count", [&] { return api().collider_move_mesh(world, b, corners, 0, 3); });
  refused("positions", [&] { return api().collider_move_mesh(world, b, nullptr, 0, 4); });
  refused("positions[1][2]", [&] { return api().collider_move_mesh(world, b, vertices, 0, 4); });
  refused("stride", [&] { return api().collider_move_mesh(world, b, corners, 11, 4); });
}

TEST_F(Collider, HandlesThatNameNothingAreRefused) {
  const pleat_collider gone = create(mesh()), alive = create(capsule());
  ASSERT_EQ(api().collider_destroy(world, gone), pleat_result{PLEAT_OK});
  const float at[3] = {0, -2, 0};
  for (const pleat_collider bad_id :
       {pleat_collider{0, 0}, pleat_collider{50, 1}, gone, pleat_collider{alive.index, alive.generation + 1}}) {
    const auto refused = [&](auto call) { expect_refused(PLEAT_ERROR_HANDLE, "collider", call); };
    refused([&] { return api().collider_destroy(world, bad_id); });
    refused([&] { return api().collider_set_enabled(world, bad_id, 1); });
    refused([&] { return api().collider_move_capsule(world, bad_id, at, at); });
    refused([&] { return api().collider_move_mesh(world, bad_id, corners, 0, 4); });
  }
}

TEST_F(Host, WithoutCollisionACollidersAbsenceIsNamed) {
  if (api().features & PLEAT_FEATURE_COLLISION) GTEST_SKIP() << "collision is compiled in";
  pleat_collider_def def = made(api().collider_def_init);
  pleat_collider out{};
  expect_refused(PLEAT_ERROR_NOT_COMPILED, "PLEAT_COLLISION", [&] { return api().collider_create(world, &def, &out); });
}

}  // namespace
}  // namespace pleat::abi
