#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

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
  /// One of each, around the cloth's middle.
  pleat_collider_def shape(std::uint32_t kind) {
    pleat_collider_def def = kind == PLEAT_COLLIDER_HULL ? mesh() : capsule();
    def.shape = kind;
    def.radius_b = 0.2f;
    def.position[1] = -1.0f;
    for (float& extent : def.half_extents) extent = 0.25f;
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
    bad("thickness", capsule(), [&](auto& d) { d.thickness = value; });
    bad("radius_b", shape(PLEAT_COLLIDER_TAPERED_CAPSULE), [&](auto& d) { d.radius_b = value; });
    bad("a", shape(PLEAT_COLLIDER_SPHERE), [&](auto& d) { d.a[1] = value; });
    for (const std::uint32_t rigid : {PLEAT_COLLIDER_PLANE, PLEAT_COLLIDER_BOX, PLEAT_COLLIDER_HULL}) {
      bad("position", shape(rigid), [&](auto& d) { d.position[2] = value; });
      bad("rotation", shape(rigid), [&](auto& d) { d.rotation[3] = value; });
    }
    bad("half_extents", shape(PLEAT_COLLIDER_BOX), [&](auto& d) { d.half_extents[1] = value; });
    float moved[12];
    std::copy(std::begin(corners), std::end(corners), moved);
    moved[7] = value;
    bad("positions[2][1]", mesh(), [&](auto& d) { d.positions = moved; });
  }
  const float flat[12] = {0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1};
  bad("positions", shape(PLEAT_COLLIDER_HULL), [&](auto& d) { d.positions = flat; });
  bad("positions", shape(PLEAT_COLLIDER_HULL), [&](auto& d) { d.positions = nullptr; });
  bad("vertex_count", shape(PLEAT_COLLIDER_HULL), [](auto& d) { d.vertex_count = 3; });
  bad("half_extents", shape(PLEAT_COLLIDER_BOX), [](auto& d) { d.half_extents[2] = 0.0f; });
  bad("size", capsule(), [](auto& d) { d.size = 2; });
  bad("shape", capsule(), [](auto& d) { d.shape = PLEAT_COLLIDER_HULL + 1; });
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

TEST_F(Collider, ABoxWithinTheLimitsIsMade) {
  pleat_collider_def box = shape(PLEAT_COLLIDER_BOX);
  for (const float thin : {1e-4f, 1e-3f}) {
    box.half_extents[0] = box.half_extents[2] = 1e4f, box.half_extents[1] = thin;
    create(box);
    box.half_extents[0] = thin;
    create(box);
  }
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

TEST_F(Collider, RigidMovesAreChecked) {
  const pleat_collider box = create(shape(PLEAT_COLLIDER_BOX)), plane = create(shape(PLEAT_COLLIDER_PLANE)),
                       round = create(capsule()), free = create(mesh());
  const float at[3] = {0, -1, 0}, wrong[3] = {0, kNan, 0}, turn[4] = {0, 0, 0.6f, 0.8f}, long_turn[4] = {0, 0, 1, 1};
  const auto refused = [&](const char* field, auto call) { expect_refused(PLEAT_ERROR_ARGUMENT, field, call); };
  for (const pleat_collider body : {box, plane}) {
    EXPECT_EQ(api().collider_move_rigid(world, body, at, turn), pleat_result{PLEAT_OK});
    refused("position[1]", [&] { return api().collider_move_rigid(world, body, wrong, turn); });
    refused("rotation", [&] { return api().collider_move_rigid(world, body, at, long_turn); });
    refused("rotation", [&] { return api().collider_move_rigid(world, body, at, nullptr); });
    refused("not a capsule", [&] { return api().collider_move_capsule(world, body, at, at); });
    refused("not a mesh", [&] { return api().collider_move_mesh(world, body, corners, 0, 4); });
  }
  for (const pleat_collider body : {round, free}) {
    refused("not a plane", [&] { return api().collider_move_rigid(world, body, at, turn); });
  }
}

TEST_F(Collider, SettingsChangeAndAreChecked) {
  for (std::uint32_t kind = 0; kind <= PLEAT_COLLIDER_HULL; ++kind) {
    pleat_collider_def def = kind == PLEAT_COLLIDER_MESH ? mesh() : shape(kind);
    def.friction = 0.5f, def.thickness = 0.01f;
    const pleat_collider id = create(def);
    pleat_collider_settings s{};
    s.size = sizeof s;
    ASSERT_EQ(api().collider_get(world, id, &s), pleat_result{PLEAT_OK});
    EXPECT_EQ(s.friction, 0.5f);
    EXPECT_EQ(s.thickness, 0.01f);
    EXPECT_EQ(s.radius_b, kind == PLEAT_COLLIDER_TAPERED_CAPSULE ? 0.2f : s.radius);
    s.friction = 0.25f;
    ASSERT_EQ(api().collider_set(world, id, &s), pleat_result{PLEAT_OK});
    pleat_collider_settings small{offsetof(pleat_collider_settings, thickness), 0.75f, kNan, kNan, kNan, 0};
    ASSERT_EQ(api().collider_set(world, id, &small), pleat_result{PLEAT_OK});
    ASSERT_EQ(api().collider_get(world, id, &s), pleat_result{PLEAT_OK});
    EXPECT_EQ(s.friction, 0.75f);
    EXPECT_EQ(s.thickness, 0.01f);
    EXPECT_EQ(s.groups, 1u);
    for (float pleat_collider_settings::*field :
         {&pleat_collider_settings::friction, &pleat_collider_settings::thickness, &pleat_collider_settings::radius,
          &pleat_collider_settings::radius_b}) {
      pleat_collider_settings spoilt = s;
      spoilt.*field = kNan;
      expect_refused(PLEAT_ERROR_ARGUMENT, "is nan", [&] { return api().collider_set(world, id, &spoilt); });
    }
    expect_refused(PLEAT_ERROR_ARGUMENT, "settings", [&] { return api().collider_get(world, id, nullptr); });
  }
}

/// Bodies of all shapes come, move, go out and go, in no order; whatever happens, handles name what they named.
TEST_F(Collider, AnyOrderOfCallsKeepsHandlesAndTheClothInOrder) {
  std::mt19937 random(9);
  const auto upto = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::vector<std::pair<pleat_collider, std::uint32_t>> alive;
  std::vector<pleat_collider> gone;
  for (int step = 0; step < 400; ++step) {
    if (alive.empty() || (upto(3) == 0 && alive.size() < 40)) {
      const auto kind = static_cast<std::uint32_t>(upto(PLEAT_COLLIDER_HULL + 1));
      pleat_collider_def def = kind == PLEAT_COLLIDER_MESH ? mesh() : shape(kind);
      def.friction = static_cast<float>(step) / 400.0f;
      alive.emplace_back(create(def), step);
      continue;
    }
    const std::size_t k = upto(alive.size());
    const pleat_collider id = alive[k].first;
    const float at[3] = {0.01f * static_cast<float>(upto(20)), -1, 0}, turn[4] = {0, 0, 0.6f, 0.8f};
    switch (upto(5)) {
      case 0:
        ASSERT_EQ(api().collider_destroy(world, id), pleat_result{PLEAT_OK});
        gone.push_back(id);
        alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(k));
        break;
      case 1:
        ASSERT_EQ(api().collider_set_enabled(world, id, step % 2 == 1), pleat_result{PLEAT_OK});
        break;
      case 2:
        api().collider_move_rigid(world, id, at, turn);
        api().collider_move_capsule(world, id, at, at);
        break;
      default:
        ASSERT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
        break;
    }
    for (const auto& [other, made_at] : alive) {
      pleat_collider_settings s{};
      s.size = sizeof s;
      ASSERT_EQ(api().collider_get(world, other, &s), pleat_result{PLEAT_OK});
      ASSERT_EQ(s.friction, static_cast<float>(made_at) / 400.0f);
    }
    for (const pleat_collider dead : gone) {
      ASSERT_EQ(api().collider_set_enabled(world, dead, 1), pleat_result{PLEAT_ERROR_HANDLE});
    }
  }
  for (const float value : state()) ASSERT_TRUE(std::isfinite(value));
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
    refused([&] { return api().collider_move_rigid(world, bad_id, at, corners); });
    pleat_collider_settings s{};
    s.size = sizeof s;
    refused([&] { return api().collider_get(world, bad_id, &s); });
    refused([&] { return api().collider_set(world, bad_id, &s); });
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
