// A cloth at rest sleeps, and wakes when anything that it depends on changes.
#include <algorithm>
#include <functional>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// A small sheet that hangs at rest from two corners, asleep.
struct Asleep : Scene {
  pleat_cloth id;
  std::vector<float> pins{-0.5f, 0, -0.5f, 0.5f, 0, -0.5f};

  explicit Asleep(float speed = 0.005f, bool at_rest = true) {
    pleat_cloth_settings s = default_settings();
    s.sleep_speed = speed;
    s.air_damping = 2.0f;  // so that the tests do not wait
    id = cloth(sheet(4), s);
    for (int i = 0; at_rest && i < 1200 && stats().sleeping == 0; ++i) step();
  }
  bool asleep() { return stats().sleeping == 1; }
};

TEST(Sleep, IsOffByDefault) {
  EXPECT_EQ(Scene::default_settings().sleep_speed, 0.0f);
  Asleep scene(0.0f, false);
  EXPECT_TRUE(scene.explain("sleep").ends_with("left out: sleep_speed is 0"));
}

TEST(Sleep, AClothAtRestStaysAsItIsAndTakesNoSubsteps) {
  Asleep scene;
  ASSERT_TRUE(scene.asleep());
  const std::vector<float> particles = scene.particles(scene.id), drawn = scene.vertices(scene.id);
  EXPECT_TRUE(std::all_of(particles.begin() + 3 * 16, particles.end(), [](float v) { return v == 0.0f; }));
  scene.step(30);
  EXPECT_TRUE(scene.asleep());
  EXPECT_EQ(scene.info(scene.id).substeps, 0u);
  EXPECT_TRUE(same_bits(scene.particles(scene.id), particles));
  EXPECT_TRUE(same_bits(scene.vertices(scene.id), drawn));
}

TEST(Sleep, WhatTheClothDependsOnWakesIt) {
  const float breeze[3] = {0, 0, 1}, moon[3] = {0, -1.6f, 0}, here[3] = {0, 0, 0};
  const std::pair<const char*, std::function<void(Asleep&)>> changes[] = {
      {"a pin",
       [](Asleep& s) {
         s.pins[1] += 1e-4f;
         must(call::cloth_move_pins(s, s.id, s.pins.data(), 0, 2));
       }},
      {"the wind", [&](Asleep& s) { must(call::world_set_wind(s, breeze)); }},
      {"gravity", [&](Asleep& s) { must(call::world_set_gravity(s, moon)); }},
      {"settings",
       [](Asleep& s) {
         const pleat_cloth_settings same = s.settings(s.id);
         must(call::cloth_set(s, s.id, &same));
       }},
      {"a jump", [&](Asleep& s) { must(call::cloth_teleport(s, s.id, here, here, nullptr)); }},
      {"a place",
       [](Asleep& s) {
         const std::vector<float> x = s.particles(s.id);
         must(call::cloth_write_particles(s, s.id, x.data(), nullptr, 16));
       }},
#ifdef PLEAT_WITH_COLLISION
      {"a new body", [](Asleep& s) { s.sphere(0, -0.4f, -0.4f, 0.1f); }},
#endif
  };
  for (const auto& [what, change] : changes) {
    Asleep scene;
    ASSERT_TRUE(scene.asleep()) << what;
    change(scene);
    scene.step();
    EXPECT_FALSE(scene.asleep()) << what;
    EXPECT_GT(scene.info(scene.id).substeps, 0u) << what;
  }
}

#ifdef PLEAT_WITH_COLLISION
TEST(Sleep, OnlyBodiesThatComeNearWakeIt) {
  Asleep scene(0.005f, false);
  const pleat_collider ball = scene.sphere(5, 0, 0, 0.1f);
  for (int i = 0; i < 1200 && !scene.asleep(); ++i) scene.step();
  const auto roll_to = [&](float x) {
    const float center[3] = {x, -0.5f, -0.5f};
    must(call::collider_move_capsule(scene, ball, center, center));
    scene.step();
  };
  for (float x = 5.0f; x > 1.0f; x -= 0.25f) {
    roll_to(x);
    ASSERT_TRUE(scene.asleep()) << x;
  }
  roll_to(0.6f);
  EXPECT_FALSE(scene.asleep());
}

TEST(Sleep, LayersWakeThoseOverThem) {
  Asleep scene(0.005f, false);
  pleat_cloth_settings s = scene.settings(scene.id);
  s.layer = 1, s.sleep_speed = 0.05f;
  must(call::cloth_set(scene, scene.id, &s));
  s.layer = 2, s.thickness = 0.05f;
  const pleat_cloth over = scene.cloth(scene.sheet(4), s);
  const float apart[] = {-0.5f, 0, -0.56f, 0.5f, 0, -0.56f};  // with room for its thickness
  must(call::cloth_move_pins(scene, over, apart, 0, 2));
  for (int i = 0; i < 1800 && scene.stats().sleeping < 2; ++i) scene.step();
  ASSERT_EQ(scene.stats().sleeping, 2u);
  scene.pins[1] += 1e-3f;
  must(call::cloth_move_pins(scene, scene.id, scene.pins.data(), 0, 2));
  scene.step();
  EXPECT_EQ(scene.stats().sleeping, 0u);
}
#endif

TEST(Sleep, WhatMovesDoesNotSleep) {
  Asleep falling(0.005f, false);
  falling.step(20);
  EXPECT_FALSE(falling.asleep());
  Asleep gusty;
  ASSERT_TRUE(gusty.asleep());
  pleat_cloth_settings s = gusty.settings(gusty.id);
  s.drag_coefficient = 1.0f, s.sleep_speed = 1.0f;
  must(call::cloth_set(gusty, gusty.id, &s));
  must(call::world_set_gust(gusty, 0.01f, 2.0f, 1));
  gusty.step(120);
  EXPECT_FALSE(gusty.asleep());
}

}  // namespace
}  // namespace pleat
