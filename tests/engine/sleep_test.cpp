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
         pleat_cloth_settings damped = s.settings(s.id);
         damped.air_damping = 2.5f;
         must(call::cloth_set(s, s.id, &damped));
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

TEST(Sleep, WhatIsSetAsItIsWakesNobody) {
  Asleep scene;
  for (int tick = 0; tick < 3; ++tick) {
    const pleat_world_def& def = scene.inside().def;
    const pleat_cloth_settings same = scene.settings(scene.id);
    must(call::cloth_set(scene, scene.id, &same));
    must(call::world_set_gravity(scene, def.gravity));
    must(call::world_set_wind(scene, def.wind));
    must(call::world_set_gust(scene, def.gust, def.gust_frequency, def.gust_seed));
    scene.step();
    EXPECT_TRUE(scene.asleep()) << tick;
  }
}

#ifdef PLEAT_WITH_SMOOTHING
TEST(Sleep, FoldsComeBackWhileItSleeps) {
  Asleep scene(0.005f, false);
  scene.step();
  for (int i = 0; i < 40; ++i) must(call::world_keep_budget(scene, 1.0f, 1000.0f));
  for (int i = 0; i < 1800 && !scene.asleep(); ++i) scene.step();
  ASSERT_TRUE(scene.asleep());
  ASSERT_EQ(scene.inside().clothes[0].fold_share, 0.0f);
  for (int i = 0; i < 10; ++i) must(call::world_keep_budget(scene, 1000.0f, 0.001f)), scene.step();
  EXPECT_GT(scene.inside().clothes[0].given_up, 0u) << "it would be taken as it wakes";
  const std::vector<float> particles = scene.particles(scene.id), flat = scene.vertices(scene.id);
  must(call::world_keep_budget(scene, 0.0f, 0.0f));
  for (int tick = 0; tick < 30; ++tick) {
    scene.step();
    EXPECT_TRUE(scene.asleep()) << tick;
  }
  EXPECT_EQ(scene.inside().clothes[0].fold_share, 1.0f);
  EXPECT_TRUE(same_bits(scene.particles(scene.id), particles));
  EXPECT_FALSE(same_bits(scene.vertices(scene.id), flat));
}
#endif

#ifdef PLEAT_WITH_COLLISION
TEST(Sleep, ABodyThatIsRefusedOrSetAsItIsWakesNobody) {
  Asleep scene(0.005f, false);
  const pleat_collider ball = scene.sphere(5, 0, 0, 0.1f);
  for (int i = 0; i < 1200 && !scene.asleep(); ++i) scene.step();
  pleat_collider_settings same{};
  same.size = sizeof same;
  must(call::collider_get(scene, ball, &same));
  must(call::collider_set(scene, ball, &same));
  same.radius_b = 0.0f;  // as it was made: a ball has none
  must(call::collider_set(scene, ball, &same));
  must(call::collider_set_enabled(scene, ball, 1));
  pleat_collider_def flat;
  must(call::collider_def_init(&flat, sizeof flat));
  flat.shape = PLEAT_COLLIDER_BOX;  // without extents
  pleat_collider none{};
  const Bytes before = scene.saved();
  EXPECT_EQ(call::collider_create(scene, &flat, &none), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(scene.saved(), before);
  scene.step();
  EXPECT_TRUE(scene.asleep());
  must(call::collider_set_enabled(scene, ball, 0));
  scene.step();
  EXPECT_FALSE(scene.asleep());
}

/// The body of another cloth, that jumps with it and so does not seem to move.
TEST(Sleep, ABodyThatJumpsToItOrAwayWakesIt) {
  for (const bool arrives : {true, false}) {
    for (const bool declared : {true, false}) {
      Asleep scene(0.005f, false);
      const float near[3] = {0, -0.5f, -0.42f}, far[3] = {20, -0.5f, -0.42f};
      const pleat_cloth other = scene.cloth(scene.sheet(3));
      std::vector<float> pins{19.5f, 1, -0.5f, 20.5f, 1, -0.5f};
      const pleat_collider body = scene.sphere(arrives ? 20 : 0, -0.5f, -0.42f, 0.1f);
      must(call::cloth_move_pins(scene, other, pins.data(), 0, 2));
      for (int i = 0; i < 1800 && !scene.asleep(); ++i) scene.step();
      ASSERT_TRUE(scene.asleep());
      const auto* from = arrives ? far : near;
      const auto* to = arrives ? near : far;
      if (declared) must(call::cloth_teleport(scene, other, from, to, nullptr));
      for (std::size_t k = 0; k < 6; k += 3) pins[k] += to[0] - from[0];
      must(call::cloth_move_pins(scene, other, pins.data(), 0, 2));
      must(call::collider_move_capsule(scene, body, to, to));
      scene.step();
      EXPECT_EQ(scene.stats().teleports, 2u);  // the first to where it hangs
      EXPECT_FALSE(scene.asleep()) << arrives << declared;
    }
  }
}

TEST(Sleep, ABodyThatJumpsPastItDoesNotWakeIt) {
  Asleep scene(0.005f, false);
  const pleat_cloth other = scene.cloth(scene.sheet(3));
  const float from[3] = {-20, 0, 0}, to[3] = {20, 0, 0};
  const pleat_collider body = scene.sphere(from[0], from[1], from[2], 0.1f);
  for (int i = 0; i < 1800 && !scene.asleep(); ++i) scene.step();
  must(call::cloth_teleport(scene, other, from, to, nullptr));
  must(call::collider_move_capsule(scene, body, to, to));
  scene.step();
  EXPECT_EQ(scene.stats().teleports, 1u);
  EXPECT_TRUE(scene.asleep());
}

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

/// Two such sheets over each other and a third elsewhere, all asleep.
struct LayersAsleep : Scene {
  pleat_garment garment = sheet(4);
  pleat_cloth under = hung(1, 0.005f, 0), over = hung(2, 0.05f, -0.06f), elsewhere = hung(1, 0.005f, 5);

  LayersAsleep() {
    for (int i = 0; i < 1800 && stats().sleeping < 3; ++i) step();
  }
  pleat_cloth hung(std::uint32_t layer, float thickness, float z) {
    pleat_cloth_settings s = default_settings();
    s.sleep_speed = 0.05f, s.air_damping = 2.0f, s.layer = layer, s.thickness = thickness;
    const pleat_cloth made = cloth(garment, s);
    std::vector<float> x = particles(made);
    x.resize(x.size() / 2);
    for (std::size_t i = 2; i < x.size(); i += 3) x[i] += z;
    place(made, x);
    return made;
  }
  void place(pleat_cloth it, const std::vector<float>& x) {
    must(call::cloth_write_particles(*this, it, x.data(), nullptr, static_cast<std::uint32_t>(x.size() / 3)));
  }
  bool awake(pleat_cloth it) { return info(it).substeps != 0; }
};

TEST(Sleep, LayersWakeThoseOverThemAndNoOthers) {
  const float here[3] = {0, 0, 0}, far[3] = {0, -20, 0};
  const auto put_in_layer = [](LayersAsleep& s, pleat_cloth cloth, std::uint32_t layer) {
    pleat_cloth_settings settings = s.settings(cloth);
    settings.layer = layer;
    must(call::cloth_set(s, cloth, &settings));
  };
  using Change = std::function<void(LayersAsleep&, pleat_cloth)>;
  const std::pair<const char*, Change> changes[] = {
      {"a pin moves",
       [](LayersAsleep& s, pleat_cloth cloth) {
         const std::vector<float> x = s.particles(cloth);
         const float pins[] = {x[0], x[1] + 1e-3f, x[2], x[9], x[10], x[11]};
         must(call::cloth_move_pins(s, cloth, pins, 0, 2));
       }},
      {"it goes", [](LayersAsleep& s, pleat_cloth cloth) { must(call::cloth_destroy(s, cloth)); }},
      {"it leaves its layer", [&](LayersAsleep& s, pleat_cloth cloth) { put_in_layer(s, cloth, 0); }},
      {"it goes into a higher layer", [&](LayersAsleep& s, pleat_cloth cloth) { put_in_layer(s, cloth, 3); }},
      {"it is placed elsewhere",
       [](LayersAsleep& s, pleat_cloth cloth) {
         std::vector<float> x = s.particles(cloth);
         x.resize(x.size() / 2);
         for (std::size_t i = 1; i < x.size(); i += 3) x[i] -= 20.0f;
         s.place(cloth, x);
       }},
      {"it is carried elsewhere",
       [&](LayersAsleep& s, pleat_cloth cloth) { must(call::cloth_teleport(s, cloth, here, far, nullptr)); }},
  };
  for (const auto& [what, change] : changes) {
    for (const bool near : {true, false}) {
      LayersAsleep scene;
      ASSERT_EQ(scene.stats().sleeping, 3u) << what;
      change(scene, near ? scene.under : scene.elsewhere);
      scene.step();
      EXPECT_EQ(scene.awake(scene.over), near) << what;
    }
  }
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
