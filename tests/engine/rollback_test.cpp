// Ticks that end badly begin anew, and where nothing helps the cloth stays as it was.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// Undamped springs without a strain limit.
pleat_cloth_settings bare() {
  pleat_cloth_settings s = Scene::default_settings();
  s.integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
  s.buckling_strain = 1.0f;
  s.stretch_limit = 1e6f;
  s.air_damping = s.edge_damping = s.bend_damping = s.inner_friction = s.bend_stiffness = 0.0f;
  return s;
}

float fastest(const std::vector<float>& state) {
  float most = 0.0f;
  for (std::size_t i = state.size() / 2; i < state.size(); ++i) most = std::max(most, std::abs(state[i]));
  return most;
}

TEST(Rollback, OrdinaryMotionHasNone) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8));
  std::vector<float> pins{-0.5f, 0, -0.5f, 0.5f, 0, -0.5f};
  for (int i = 0; i < 60; ++i) {  // shaken at up to 12 m/s
    for (std::size_t k = 1; k < pins.size(); k += 3) pins[k] = 0.4f * std::sin(30.0f * static_cast<float>(i) / 60.0f);
    must(call::cloth_move_pins(scene, cloth, pins.data(), 0, 2));
    scene.step();
  }
  EXPECT_EQ(scene.stats().rollbacks, 0u);
}

TEST(Rollback, WhatTheBorderLetsInIsNoTrouble) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4));
  std::vector<float> state = scene.particles(cloth);
  for (std::size_t i = 0; i < 3 * 16; ++i) state[i] += i % 3 == 2 ? 0.0f : 9.9e5f;
  must(call::cloth_write_particles(scene, cloth, state.data(), nullptr, 16));
  scene.step(10);
  EXPECT_EQ(scene.stats().nonfinite_restored, 0u);
  EXPECT_EQ(scene.stats().rollbacks, 0u);
}

TEST(Rollback, AStretchedSheetThatIsLetGoHasNone) {
  for (const std::uint32_t side : {8u, 20u}) {  // within reach of its pins; with tethers and coarse levels
    Scene scene;
    const pleat_cloth cloth = scene.cloth(scene.sheet(side));
    std::vector<float> state = scene.particles(cloth);
    for (std::size_t i = 0; i < 3 * side * side; ++i) state[i] *= 3.0f;
    must(call::cloth_write_particles(scene, cloth, state.data(), nullptr, side * side));
    scene.step(10);
    EXPECT_EQ(scene.stats().rollbacks, 0u);
  }
}

/// A storm that lifts more than it drags feeds springs that have no damping: 8 substeps a tick are too few for it.
TEST(Rollback, MoreSubstepsHelpWhereTheyCan) {
  Scene scene;
  pleat_cloth_settings s = bare();
  s.stiffness = 60.0f, s.substeps = 8;
  s.drag_coefficient = 1.0f, s.lift_coefficient = 30.0f;
  scene.cloth(scene.sheet(8), s);
  const float wind[3] = {20, 3, 20};
  must(call::world_set_wind(scene, wind));
  scene.step(30, 1.0f / 30);
  EXPECT_GT(scene.stats().rollbacks, 5u);
  EXPECT_LT(scene.stats().fallbacks, scene.stats().rollbacks);
}

TEST(Rollback, WhereNothingHelpsTheClothStaysWithItsPins) {
  std::vector<std::string> lines;
  pleat_world_def def = Scene::default_def();
  def.log = [](std::uint32_t level, const char* line, void* user) {
    if (level == PLEAT_LOG_WARNING) static_cast<std::vector<std::string>*>(user)->push_back(line);
  };
  def.log_user = &lines;
  Scene scene(def);
  pleat_cloth_settings s = bare();
  s.integrator = PLEAT_INTEGRATOR_EXPLICIT_EULER;  // never stable without damping
  s.stiffness = 1e5f;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
  std::vector<float> pins{-0.5f, 0, -0.5f, 0.5f, 0, -0.5f};
  for (int i = 0; i < 60; ++i) {
    for (std::size_t k = 0; k < pins.size(); k += 3) pins[k] += 0.05f;
    must(call::cloth_move_pins(scene, cloth, pins.data(), 0, 2));
    scene.step(1, 1.0f / 30);
    const std::vector<float> state = scene.particles(cloth);
    ASSERT_TRUE(std::all_of(state.begin(), state.end(), [](float x) { return std::isfinite(x); }));
    ASSERT_LT(fastest(state), 50.0f) << "tick " << i;
    for (std::size_t k = 0; k < 3 * 64; k += 3) ASSERT_NEAR(state[k], pins[0] + 0.5f, 1.5f) << "left behind";
  }
  EXPECT_GT(scene.stats().fallbacks, 10u);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) { return line.find("stays as it was") != std::string::npos; }),
            1);
}

TEST(Rollback, WhatIsLeftBehindIsAStateThatLoads) {
  Scene scene;
  scene.cloth(scene.sheet(8));
  scene.step(2);
  scene.inside().particles.velocity.y[20] = std::numeric_limits<float>::infinity();
  scene.step();
  ASSERT_EQ(scene.stats().fallbacks, 1u);
  EXPECT_EQ(scene.load(scene.saved()), pleat_result{PLEAT_OK});
}

#if defined(PLEAT_WITH_COLLISION) && defined(PLEAT_WITH_SMOOTHING)
TEST(Rollback, WhereNothingHelpsTheClothIsDrawnBesideBodiesAsTheyAreAtTheEnd) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8));
  const pleat_collider ball = scene.sphere(0, -0.36f, 0.1f, 0.25f);
  scene.step(60);
  scene.inside().particles.velocity.y[20] = std::numeric_limits<float>::infinity();
  const float away[] = {0, -5, 0.1f};
  must(call::collider_move_capsule(scene, ball, away, away));
  scene.step();
  ASSERT_EQ(scene.stats().fallbacks, 1u);
  EXPECT_EQ(scene.stats().particle_contacts + scene.stats().face_contacts, 0u) << "of what was given up";
  const std::vector<float> drawn = scene.vertices(cloth);
  const pleat_cloth_settings same = scene.settings(cloth);
  must(call::cloth_set(scene, cloth, &same));  // draws it anew
  const std::vector<float> anew = scene.vertices(cloth);
  for (std::size_t i = 0; i < drawn.size(); ++i) ASSERT_NEAR(drawn[i], anew[i], 1e-5f) << i;
}
#endif

TEST(Rollback, ATickThatBreaksCostsNoMoreThanThreeLongOnes) {
  Scene scene;
  pleat_cloth_settings s = bare();
  s.integrator = PLEAT_INTEGRATOR_EXPLICIT_EULER;
  s.stiffness = 1e5f;
  for (const std::uint32_t substeps : {1u, 16u, 32u, 33u, 64u}) {
    s.substeps = substeps;
    const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
    std::uint32_t most = 0;
    for (int i = 0; i < 20; ++i) {
      scene.step(1, 1.0f / 30);
      pleat_cloth_info info{};
      info.size = sizeof info;
      must(call::cloth_info(scene, cloth, &info));
      most = std::max(most, info.substeps);
    }
    EXPECT_EQ(most, substeps > 32 ? 2 * substeps : 4 * substeps);
    must(call::cloth_destroy(scene, cloth));
  }
}

}  // namespace
}  // namespace pleat
