// Ticks that far cloths do without: who does, how they go with their pins meanwhile, and that no body goes through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr float kFrame = 1.0f / 30;  // s
constexpr int kLongest = 8;          // ticks

/// Sheets that hang from two corners, on characters that turn about the upright axis as they walk.
struct Parade {
  Scene scene;
  std::vector<pleat_cloth> cloths;
  std::vector<float> rest;  // of the pins
  int frame = 0;
  float speed = 0.0f, spin = 0.0f;  // m/s, rad/s

  explicit Parade(int count, const pleat_cloth_settings& settings = Scene::default_settings(),
                  const pleat_world_def& def = Scene::default_def())
      : scene(def) {
    const pleat_garment sheet = scene.sheet(7);
    for (int k = 0; k < count; ++k) cloths.push_back(scene.cloth(sheet, settings));
    const std::vector<float> x = scene.particles(cloths[0]);
    for (const std::size_t pin : {0u, 6u}) rest.insert(rest.end(), &x[3 * pin], &x[3 * pin + 3]);
    tick(62);  // old enough to wait
  }
  World& world() { return scene.inside(); }
  ClothRecord& record(std::size_t k = 0) { return world().clothes[k]; }
  std::vector<float> pins() const {
    const float t = kFrame * static_cast<float>(frame), c = std::cos(spin * t), s = std::sin(spin * t);
    std::vector<float> placed(6);
    for (std::size_t k = 0; k < 6; k += 3) {
      placed[k] = c * rest[k] + s * rest[k + 2] + speed * t;
      placed[k + 1] = rest[k + 1];
      placed[k + 2] = c * rest[k + 2] - s * rest[k];
    }
    return placed;
  }
  void tick(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) {
      ++frame;
      if (speed != 0.0f || spin != 0.0f) {
        for (const pleat_cloth cloth : cloths) must(call::cloth_move_pins(scene, cloth, pins().data(), 0, 2));
      }
      scene.step(1, kFrame);
    }
  }
  void go(float metres_a_second, float radians_a_second) {
    speed = metres_a_second, spin = radians_a_second;
    frame = 0;
  }
  void give_up_all() {
    for (int i = 0; i < 40; ++i) must(call::world_keep_budget(scene, 1.0f, 1000.0f));
    tick(9);  // folds fade first
  }
  int waiting() {
    return static_cast<int>(std::ranges::count_if(world().clothes, [](const ClothRecord& c) { return c.carried; }));
  }
};

TEST(Turns, EachClothTakesOneTickOfEightAndAllTakeTurns) {
  Parade p(16);
  EXPECT_EQ(p.waiting(), 0);
  EXPECT_NE(p.scene.explain("carry_with_pins").find("takes every tick"), std::string::npos);
  p.give_up_all();
  EXPECT_EQ(p.scene.stats().ticks_given_up, 16u);
  std::vector<int> taken(16, 0);
  for (int tick = 0; tick < 3 * kLongest; ++tick) {
    p.tick();
    EXPECT_EQ(p.waiting(), 14);
    for (std::size_t k = 0; k < 16; ++k) taken[k] += p.record(k).carried ? 0 : 1;
  }
  EXPECT_EQ(taken, std::vector<int>(16, 3));
  must(call::world_keep_budget(p.scene, 0.0f, 0.0f));
  p.tick();
  EXPECT_EQ(p.waiting(), 0);
}

TEST(Turns, ClothThatWaitsGoesRigidlyWithItsPins) {
  pleat_cloth_settings s = Scene::default_settings();
#ifdef PLEAT_WITH_SMOOTHING
  s.tangents = 1;
#endif
  Parade p(1, s);
  p.tick(40);
  p.give_up_all();
  p.tick(20);
  p.go(2.0f, 1.5f);
  int waited = 0;
  for (int tick = 0; tick < 2 * kLongest; ++tick) {
    const std::vector<float> before = p.scene.particles(p.cloths[0]), drawn = p.scene.vertices(p.cloths[0]);
    const std::vector<float> from = p.pins();
    p.tick();
    if (!p.record().carried) continue;
    ++waited;
    // About the middle between the pins, by the turn of a tick.
    const std::vector<float> to = p.pins();
    const float c = std::cos(1.5f * kFrame), s1 = std::sin(1.5f * kFrame);
    const auto goes_along = [&](const float* was, const float* is, bool place) {
      float a[3], b[3];
      for (int k = 0; k < 3; ++k) {
        a[k] =
            was[k] - (place ? 0.5f * (from[static_cast<std::size_t>(k)] + from[static_cast<std::size_t>(k + 3)]) : 0);
        b[k] = is[k] - (place ? 0.5f * (to[static_cast<std::size_t>(k)] + to[static_cast<std::size_t>(k + 3)]) : 0);
      }
      return std::hypot(c * a[0] + s1 * a[2] - b[0], a[1] - b[1], c * a[2] - s1 * a[0] - b[2]);
    };
    const std::vector<float> after = p.scene.particles(p.cloths[0]), redrawn = p.scene.vertices(p.cloths[0]);
    const std::size_t half = before.size() / 2;
    for (std::size_t i = 0; i < half; i += 3) {
      EXPECT_LT(goes_along(&before[i], &after[i], true), 2e-5f) << i;
      EXPECT_LT(goes_along(&before[half + i], &after[half + i], false), 2e-5f) << i;
    }
    for (std::size_t i = 0; i < drawn.size(); i += 8) {
      EXPECT_LT(goes_along(&drawn[i], &redrawn[i], true), 2e-5f) << i;
      EXPECT_LT(goes_along(&drawn[i + 3], &redrawn[i + 3], false), 2e-5f) << i;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(after[k], to[k]) << "pins are where the host wants them";
      EXPECT_EQ(after[18 + k], to[3 + k]);
    }
  }
  EXPECT_EQ(waited, 14);
}

TEST(Turns, LayersAndClothWithItsOwnSubstepsTakeEveryTick) {
  const auto takes_every_tick = [](const pleat_cloth_settings& s) {
    Parade p(1, s);
    p.give_up_all();
    p.tick(3);
    EXPECT_EQ(p.scene.stats().ticks_given_up, 0u);
    EXPECT_EQ(p.waiting(), 0);
  };
  pleat_cloth_settings own = Scene::default_settings();
  own.substeps = 4;
  takes_every_tick(own);
#ifdef PLEAT_WITH_COLLISION
  pleat_cloth_settings layer = Scene::default_settings();
  layer.layer = 1;
  takes_every_tick(layer);
#endif
}

/// It would stop in the air.
TEST(Turns, ClothWithoutPinsTakesEveryTick) {
  Scene scene;
  scene.cloth(scene.sheet(7, 0)), scene.cloth(scene.sheet(7));
  scene.step(62, kFrame);
  for (int i = 0; i < 40; ++i) must(call::world_keep_budget(scene, 1.0f, 1000.0f));
  int free_waits = 0, hanging_waits = 0;
  for (int tick = 0; tick < 2 * kLongest; ++tick) {
    scene.step(1, kFrame);
    free_waits += scene.inside().clothes[0].carried, hanging_waits += scene.inside().clothes[1].carried;
  }
  EXPECT_EQ(free_waits, 0);
  EXPECT_GT(hanging_waits, kLongest / 2);
  EXPECT_EQ(scene.stats().ticks_given_up, 1u);
}

TEST(Turns, ClothsBetweenThatTakeAllTicksDoNotMatter) {
  Parade p(1);
  pleat_cloth_settings own = Scene::default_settings();
  own.substeps = 2;
  const pleat_garment sheet = p.scene.sheet(7);
  for (int k = 0; k < 15; ++k) p.scene.cloth(sheet, own), p.cloths.push_back(p.scene.cloth(sheet));
  p.scene.step(62, kFrame);
  p.give_up_all();
  for (int tick = 0; tick < 2 * kLongest; ++tick) {
    p.tick();
    EXPECT_EQ(p.waiting(), 14);
  }
}

TEST(Turns, AJumpTakesWhatIsDrawnAlong) {
  for (const float way : {3.0f, 20.0f}) {
    for (const bool declared : {true, false}) {
      pleat_cloth_settings s = Scene::default_settings();
      s.teleport_speed = 10.0f;
      Parade p(1, s);
      p.give_up_all();
      do p.tick();
      while (!p.record().carried);
      const std::vector<float> before = p.scene.vertices(p.cloths[0]);
      std::vector<float> pins = p.pins();
      for (std::size_t k = 0; k < 6; k += 3) pins[k] += way;
      const float from[] = {0, 0, 0}, to[] = {way, 0, 0};
      if (declared) must(call::cloth_teleport(p.scene, p.cloths[0], from, to, nullptr));
      must(call::cloth_move_pins(p.scene, p.cloths[0], pins.data(), 0, 2));
      p.scene.step(1, kFrame);
      ASSERT_EQ(p.scene.stats().teleports, 1u);
      const std::vector<float> after = p.scene.vertices(p.cloths[0]);
      for (std::size_t i = 0; i < before.size(); i += 8) EXPECT_NEAR(after[i], before[i] + way, 0.05f);
    }
  }
}

TEST(Turns, WhatMovesInATickThatItWaitsWakesIt) {
  pleat_cloth_settings s = Scene::default_settings();
  s.sleep_speed = 0.01f, s.air_damping = 2.0f;
  Parade p(1, s);
  p.tick(300);
  ASSERT_EQ(p.scene.stats().sleeping, 1u);
  must(call::cloth_set_visible(p.scene, p.cloths[0], 0));
  p.tick();
  // Pins turn about the way from one to the other, by a quarter: the cloth hangs sideways, and falls.
  while ((p.world().turn + 1) % 8 != 1) p.tick();
  std::vector<float> pins = p.pins();
  pins[1] += 0.5f, pins[4] -= 0.5f, pins[0] += 0.5f, pins[3] -= 0.5f;  // one above the other
  must(call::cloth_move_pins(p.scene, p.cloths[0], pins.data(), 0, 2));
  p.scene.step(1, kFrame);
  EXPECT_EQ(p.scene.stats().sleeping, 0u);
  ASSERT_TRUE(p.record().carried);
  const std::vector<float> turned = p.scene.particles(p.cloths[0]);
  p.scene.step(100, kFrame);
  const std::vector<float> later = p.scene.particles(p.cloths[0]);
  float most = 0.0f;
  for (std::size_t i = 0; i < turned.size() / 2; ++i) most = std::max(most, std::abs(later[i] - turned[i]));
  EXPECT_GT(most, 0.2f);
}

TEST(Turns, ParticlesThatTheHostWritesTakeEveryTick) {
  Parade p(1);
  p.give_up_all();
  do p.tick();
  while (!p.record().carried);
  const std::vector<float> x = p.scene.particles(p.cloths[0]);
  const auto n = static_cast<std::uint32_t>(x.size() / 6);
  must(call::cloth_write_particles(p.scene, p.cloths[0], x.data(), nullptr, n));
  for (int tick = 0; tick < kLongest; ++tick) {
    p.tick();
    EXPECT_FALSE(p.record().carried);
  }
}

TEST(Turns, ClothThatNobodySeesWaitsAndIsThereAtOnce) {
  Parade p(1);
  must(call::cloth_set_visible(p.scene, p.cloths[0], 0));
  int waited = 0;
  for (int tick = 0; tick < 2 * kLongest; ++tick) p.tick(), waited += p.waiting();
  EXPECT_EQ(waited, 14);
  EXPECT_EQ(p.scene.stats().ticks_given_up, 0u) << "nothing that could be seen";
  while (p.record().carried) p.tick();
  p.tick();
  ASSERT_TRUE(p.record().carried);
  must(call::cloth_set_visible(p.scene, p.cloths[0], 1));
  p.tick();
  EXPECT_FALSE(p.record().carried);
}

TEST(Turns, AStateInBetweenGoesOnWithTheSameBits) {
  Parade p(3), other(3);
  p.give_up_all();
  p.go(1.0f, 1.0f);
  p.tick(13);
  const Bytes state = p.scene.saved();
  ASSERT_EQ(other.scene.load(state), pleat_result{PLEAT_OK});
  other.go(1.0f, 1.0f);
  other.frame = p.frame;
  for (int tick = 0; tick < 20; ++tick) {
    p.tick(), other.tick();
    for (Parade* each : {&p, &other}) must(call::world_keep_budget(each->scene, 1.0f, 1.5f));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_TRUE(same_bits(p.scene.particles(p.cloths[k]), other.scene.particles(other.cloths[k]))) << tick;
      EXPECT_TRUE(same_bits(p.scene.vertices(p.cloths[k]), other.scene.vertices(other.cloths[k]))) << tick;
    }
  }
}

TEST(Turns, AnyNumberOfWorkersGivesTheSameBits) {
  const auto play = [](std::uint32_t workers) {
    pleat_world_def def = Scene::default_def();
    def.workers = workers;
    Parade p(9, Scene::default_settings(), def);
    p.give_up_all();
    p.go(1.0f, 1.0f);
    std::vector<float> all;
    for (int tick = 0; tick < 20; ++tick) {
      p.tick();
      EXPECT_GT(p.waiting(), 6);
      for (const pleat_cloth cloth : p.cloths) {
        const std::vector<float> drawn = p.scene.vertices(cloth);
        all.insert(all.end(), drawn.begin(), drawn.end());
      }
    }
    return all;
  };
  EXPECT_TRUE(same_bits(play(1), play(3)));
}

TEST(Turns, NothingIsAllocated) {
  Parade p(3);
  p.give_up_all();
  const std::uint64_t before = global_allocations(), counted = p.scene.stats().allocations;
  for (int tick = 0; tick < 20; ++tick) {
    p.tick();
    must(call::world_keep_budget(p.scene, 1.0f, tick % 10 < 5 ? 100.0f : 0.01f));
  }
  EXPECT_EQ(global_allocations(), before);
  EXPECT_EQ(p.scene.stats().allocations, counted);
}

#ifdef PLEAT_WITH_COLLISION
/// How deep particles and triangles are in bodies, m.
float depth(Parade& p) {
  pleat_contact_report report{};
  report.size = sizeof report;
  must(call::cloth_contact_report(p.scene, p.cloths[0], &report));
  return std::max(report.particle_depth, report.face_depth);
}

TEST(Turns, ABodyThatComesNearIsNotMissed) {
  // A bar swings through where the cloth hangs, slowly and then too fast for a tick of eight.
  struct Swing {
    float speed, radius, dt;
  };
  for (const auto& [speed, radius, dt] :
       {Swing{0.2f, 0.08f, kFrame}, Swing{1, 0.08f, kFrame}, Swing{4, 0.08f, kFrame}, Swing{0.6f, 0.15f, 1.0f / 120}}) {
    SCOPED_TRACE(speed);
    Parade p(1);
    p.tick(60);
    p.give_up_all();
    p.tick(20);
    const pleat_collider bar = p.scene.sphere(0, -0.5f, 5, radius);
    float deepest = 0.0f;
    const float reach = 0.8f;
    for (float z = -reach; z < reach; z += speed * dt) {
      const float a[] = {-0.6f, -0.5f, z}, b[] = {0.6f, -0.5f, z};
      must(call::collider_move_capsule(p.scene, bar, a, b));
      p.scene.step(1, dt);
      if (z > -reach) deepest = std::max(deepest, depth(p));
    }
    EXPECT_LT(deepest, 0.045f) << "half of radius and thickness, or what is taken back in a tick";
    // The cloth lies on the bar, and not behind it.
    must(call::world_keep_budget(p.scene, 0.0f, 0.0f));
    p.tick(30);
    EXPECT_LT(depth(p), 1e-3f);
  }
}

TEST(Turns, ClothIsNotCarriedIntoTheGround) {
  Parade p(1);
  p.give_up_all();
  p.tick(20);
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def));
  def.shape = PLEAT_COLLIDER_PLANE;
  def.position[1] = -1.5f;
  pleat_collider ground{};
  must(call::collider_create(p.scene, &def, &ground));
  float deepest = 0.0f;
  for (int tick = 0; tick < 20; ++tick) {  // at 2 m/s
    for (const std::size_t k : {1u, 4u}) p.rest[k] -= 2.0f * kFrame;
    must(call::cloth_move_pins(p.scene, p.cloths[0], p.pins().data(), 0, 2));
    p.scene.step(1, kFrame);
    deepest = std::max(deepest, depth(p));
  }
  EXPECT_LT(deepest, 0.01f) << "half of what contact looks for, and rounding";
}

/// A bar of triangles goes forward through where the sheet hangs.
TEST(Turns, AMeshThatComesNearIsNotMissed) {
  Parade p(1);
  p.tick(60);
  p.give_up_all();
  p.tick(20);
  std::vector<float> x;
  for (int k = 0; k < 8; ++k) {
    for (const float c : {k & 1 ? 0.6f : -0.6f, k & 2 ? -0.4f : -0.6f, k & 4 ? 0.05f : -0.05f}) x.push_back(c);
  }
  const std::uint32_t faces[] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  const auto at = [&](float z) {
    std::vector<float> moved = x;
    for (std::size_t i = 2; i < moved.size(); i += 3) moved[i] += z;
    return moved;
  };
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def));
  def.shape = PLEAT_COLLIDER_MESH;
  const std::vector<float> start = at(-1.8f);
  def.positions = start.data(), def.vertex_count = 8, def.triangles = faces, def.triangle_count = 12;
  pleat_collider bar{};
  must(call::collider_create(p.scene, &def, &bar));
  float deepest = 0.0f;
  for (float z = -1.8f; z < 0.6f; z += 0.6f * kFrame) {
    must(call::collider_move_mesh(p.scene, bar, at(z).data(), 0, 8));
    p.tick();
    deepest = std::max(deepest, depth(p));
  }
  EXPECT_LT(deepest, 0.02f);
  must(call::world_keep_budget(p.scene, 0.0f, 0.0f));
  p.tick(30);
  EXPECT_LT(depth(p), 2e-3f);
}
#endif

}  // namespace
}  // namespace pleat
