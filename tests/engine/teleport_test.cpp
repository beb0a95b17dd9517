// A character is placed elsewhere: its cloth comes along as it was.
#include <algorithm>

#include "components/rigid_pose.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 9;
const RigidMotion kJump{{0, 0, 0}, {12, 3, -5}, {0, 0.8f, 0, 0.6f}};  // 106 degrees about y

/// A sheet that hangs from two corners over a ball, a moment after its release.
struct Hanging : Scene {
  pleat_cloth cloth_id;
#ifdef PLEAT_WITH_COLLISION
  pleat_collider ball = sphere(kBall.x, kBall.y, kBall.z, 0.15f);
#endif
  static constexpr Vec3 kBall{0, -0.25f, 0.1f};
  std::vector<float> pins{-0.5f, 0, -0.5f, 0.5f, 0, -0.5f};

  explicit Hanging(float teleport_speed = 50.0f) {
    pleat_cloth_settings s = default_settings();
    s.teleport_speed = teleport_speed;
    cloth_id = cloth(sheet(kSide), s);
    step(40);
  }
  /// Pins and ball for the next tick.
  void place(const RigidMotion& motion) {
    for (std::size_t k = 0; k < pins.size(); k += 3) {
      const Vec3 p = motion.apply({pins[k], pins[k + 1], pins[k + 2]});
      pins[k] = p.x, pins[k + 1] = p.y, pins[k + 2] = p.z;
    }
    must(call::cloth_move_pins(*this, cloth_id, pins.data(), 0, 2));
#ifdef PLEAT_WITH_COLLISION
    const Vec3 b = motion.apply(kBall);
    const float center[3] = {b.x, b.y, b.z};
    must(call::collider_move_capsule(*this, ball, center, center));
#endif
  }
  void declare(const RigidMotion& m) {
    const float from[3] = {m.from.x, m.from.y, m.from.z}, to[3] = {m.to.x, m.to.y, m.to.z};
    const float rotation[4] = {m.rotation.x, m.rotation.y, m.rotation.z, m.rotation.w};
    must(call::cloth_teleport(*this, cloth_id, from, to, rotation));
  }
};

/// The greatest distance between a particle and where `motion` brings that of another cloth, m.
float distance_after(const RigidMotion& motion, const std::vector<float>& here, const std::vector<float>& there) {
  float most = 0.0f;
  for (std::size_t i = 0; i < 3 * kSide * kSide; i += 3) {
    const Vec3 p = motion.apply({here[i], here[i + 1], here[i + 2]});
    most = std::max(most, length(p - Vec3{there[i], there[i + 1], there[i + 2]}));
  }
  return most;
}

TEST(Teleport, AFoundJumpChangesNothingButThePlace) {
  Hanging stays, jumps;
  stays.step();
  jumps.place(kJump);
  jumps.step();
  EXPECT_EQ(jumps.stats().teleports, 1u);
  EXPECT_LT(distance_after(kJump, stays.particles(stays.cloth_id), jumps.particles(jumps.cloth_id)), 1e-4f);
  // Ever after. Folds differ by rounding, which contact doubles every three ticks: another 15 would make it 6 mm.
  stays.step(15), jumps.step(15);
  EXPECT_LT(distance_after(kJump, stays.particles(stays.cloth_id), jumps.particles(jumps.cloth_id)), 1e-3f);
  EXPECT_EQ(jumps.stats().teleports, 1u);
  EXPECT_EQ(stays.stats().teleports, 0u);
}

TEST(Teleport, WithoutItTheClothIsFlung) {
  Hanging stays, jumps(0.0f);
  stays.step();
  jumps.place(kJump);
  jumps.step();
  EXPECT_EQ(jumps.stats().teleports, 0u);
  EXPECT_GT(distance_after(kJump, stays.particles(stays.cloth_id), jumps.particles(jumps.cloth_id)), 0.1f);
}

TEST(Teleport, ADeclaredJumpIsTheSameInAnyOrder) {
  const RigidMotion step_aside{{0, 0, 0}, {0.1f, 0, 0}, {0, 0.6f, 0, 0.8f}};  // too small to be found
  Hanging stays, before(0.0f), after;
  stays.step();
  before.declare(step_aside), before.place(step_aside), before.step();
  after.place(step_aside), after.declare(step_aside), after.step();
  EXPECT_EQ(before.stats().teleports, 1u);
  EXPECT_EQ(after.stats().teleports, 1u);
  EXPECT_TRUE(same_bits(before.particles(before.cloth_id), after.particles(after.cloth_id)));
  EXPECT_LT(distance_after(step_aside, stays.particles(stays.cloth_id), after.particles(after.cloth_id)), 1e-4f);
}

TEST(Teleport, PinsThatAreNotMovedComeAlong) {
  Hanging stays, jumps;
#ifdef PLEAT_WITH_COLLISION
  for (Hanging* scene : {&stays, &jumps}) must(call::collider_destroy(*scene, scene->ball));
#endif
  const RigidMotion first{{0, 0, 0}, {3, 0, 0}, {}}, second{{3, 0, 0}, kJump.to, kJump.rotation};
  jumps.declare(first), jumps.declare(second);  // one after the other
  stays.step(), jumps.step();
  EXPECT_LT(distance_after(kJump, stays.particles(stays.cloth_id), jumps.particles(jumps.cloth_id)), 1e-4f);
  EXPECT_EQ(jumps.stats().teleports, 1u);
}

TEST(Teleport, AClothWithoutPinsIsCarriedWhenDeclared) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4));
  const float none[3] = {0, 0, 0}, away[3] = {0, 100, 0};
  must(call::world_set_gravity(scene, none));
  must(call::cloth_teleport(scene, cloth, none, away, nullptr));
  scene.step();
  EXPECT_EQ(scene.particles(cloth)[1], 100.0f);
}

TEST(Teleport, PinsThatAreToldToStayStay) {
  Hanging scene;
  scene.declare({{0, 0, 0}, {0.5f, 0, 0}, {}});  // the way back is no jump
  must(call::cloth_move_pins(scene, scene.cloth_id, scene.pins.data(), 0, 2));
  scene.step();
  EXPECT_EQ(scene.stats().teleports, 1u);
  const std::vector<float> x = scene.particles(scene.cloth_id);
  EXPECT_EQ(x[0], scene.pins[0]);
  EXPECT_EQ(x[3 * (kSide - 1)], scene.pins[3]);
}

TEST(Teleport, BeyondTheWorldIsRefused) {
  Hanging scene;
  const float here[3] = {0, 0, 0}, far[3] = {9e5f, 0, 0}, edge[3] = {1e6f, 0, 0}, back[3] = {-9e5f, 0, 0};
  must(call::cloth_teleport(scene, scene.cloth_id, here, far, nullptr));
  EXPECT_EQ(call::cloth_teleport(scene, scene.cloth_id, here, far, nullptr), pleat_result{PLEAT_ERROR_ARGUMENT});
  for (int i = 0; i < 20; ++i) {  // there and back
    must(call::cloth_teleport(scene, scene.cloth_id, here, back, nullptr));
    must(call::cloth_teleport(scene, scene.cloth_id, here, far, nullptr));
  }
  EXPECT_EQ(scene.load(scene.saved()), pleat_result{PLEAT_OK});
  scene.step(2);
  EXPECT_NEAR(scene.particles(scene.cloth_id)[0], 9e5f - 0.5f, 0.1f);
  EXPECT_EQ(scene.stats().fallbacks, 0u);
  EXPECT_EQ(call::cloth_teleport(scene, scene.cloth_id, here, edge, nullptr), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(scene.load(scene.saved()), pleat_result{PLEAT_OK});
}

/// At a speed of more than teleport_speed.
struct OnATrain : Hanging {
  const RigidMotion ahead{{0, 0, 0}, {100.0f / 60, 0, 0}, {}};

  explicit OnATrain(float teleport_speed) : Hanging(teleport_speed) {
#ifdef PLEAT_WITH_COLLISION
    must(call::collider_destroy(*this, ball));
    ball = sphere(0, -50, 0, 0.1f);
#endif
    go(5);
  }
  void go(int ticks) {
    for (int i = 0; i < ticks; ++i) place(ahead), step();
  }
};

TEST(Teleport, AClothThatIsWrittenAsItWasGoesOn) {
  OnATrain train(50.0f);
  const std::vector<float> state = train.particles(train.cloth_id);
  const std::uint64_t before = train.stats().teleports;
  must(call::cloth_write_particles(train, train.cloth_id, state.data(), state.data() + 3 * kSide * kSide,
                                   kSide * kSide));
  train.go(3);
  EXPECT_EQ(train.stats().teleports, before);
}

TEST(Teleport, WhatGoesFastAsItIsLookedForDoesNotJump) {
  OnATrain train(0.0f);
  pleat_cloth_settings s = train.settings(train.cloth_id);
  s.teleport_speed = 50.0f;
  must(call::cloth_set(train, train.cloth_id, &s));
  train.go(3);
  EXPECT_EQ(train.stats().teleports, 0u);
}

TEST(Teleport, PlacingTheClothAnewEndsIt) {
  Hanging scene;
  std::vector<float> state = scene.particles(scene.cloth_id);
  scene.declare(kJump);
  must(call::cloth_write_particles(scene, scene.cloth_id, state.data(), nullptr, kSide * kSide));
  scene.step();
  EXPECT_EQ(scene.stats().teleports, 0u);
}

TEST(Teleport, TwentyTurnsASecondAreNoJump) {
  Hanging scene;
  const float angle = 20.0f * 6.2831853f / 60.0f;
  const RigidMotion turn{{0, 0, -0.5f}, {0, 0, -0.5f}, {0, std::sin(0.5f * angle), 0, std::cos(0.5f * angle)}};
  for (int i = 0; i < 20; ++i) scene.place(turn), scene.step();
  EXPECT_EQ(scene.stats().teleports, 0u);
}

TEST(Teleport, ADeclaredTurnOfATrainIsNoSecondJump) {
  const RigidMotion ahead{{0, 0, 0}, {1, 0, 0}, {}}, aside{{0, 0, 0}, {0, 0, -1}, {}};  // 60 m/s
  const RigidMotion turn{{0, 0, 0}, {0, 0, 0}, {0, 0.70710678f, 0, 0.70710678f}};       // that brings x to -z
  Hanging stays, turns;
  for (Hanging* scene : {&stays, &turns}) {
#ifdef PLEAT_WITH_COLLISION
    must(call::collider_destroy(*scene, scene->ball));
    scene->ball = scene->sphere(0, -50, 0, 0.1f);
#endif
    for (int i = 0; i < 5; ++i) scene->place(ahead), scene->step();
  }
  stays.place(ahead), stays.step();
  turns.declare(turn), turns.place(turn), turns.place(aside), turns.step();
  EXPECT_LT(distance_after(turn, stays.particles(stays.cloth_id), turns.particles(turns.cloth_id)), 1e-3f);
}

TEST(Teleport, TheLogSaysOnceThatAJumpWasFound) {
  std::vector<std::string> lines;
  pleat_world_def def = Scene::default_def();
  def.log = [](std::uint32_t, const char* line, void* user) {
    static_cast<std::vector<std::string>*>(user)->push_back(line);
  };
  def.log_user = &lines;
  Scene scene(def);
  const pleat_cloth cloth = scene.cloth(scene.sheet(3));
  for (int i = 1; i <= 3; ++i) {
    const float x = i % 2 == 0 ? 0.0f : 10.0f, pins[] = {x - 0.5f, 0, -0.5f, x + 0.5f, 0, -0.5f};
    must(call::cloth_move_pins(scene, cloth, pins, 0, 2));
    scene.step();
  }
  EXPECT_EQ(scene.stats().teleports, 3u);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("10.0"), std::string::npos) << lines[0];
}

}  // namespace
}  // namespace pleat
