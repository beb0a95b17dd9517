// Cloths that nobody sees: what they save, what they keep, and how they come back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr float kFrame = 1.0f / 30;  // s

/// A sheet that hangs from two corners.
struct Hanging : Scene {
  pleat_cloth id;

  explicit Hanging(const pleat_cloth_settings& s = default_settings()) : id(cloth(sheet(7), s)) {}
  void show(bool visible) { must(call::cloth_set_visible(*this, id, visible ? 1 : 0)); }
  void tick(int ticks) { step(ticks, kFrame); }
  std::uint32_t substeps() { return info(id).substeps; }
};

pleat_result read_one_vertex(Hanging& scene) {
  float vertex[3];
  pleat_vertex_target target{};
  must(call::vertex_target_init(&target, sizeof target));
  target.data = vertex, target.stride = sizeof vertex, target.position_offset = 0;
  target.capacity = scene.info(scene.id).drawn_vertices;
  return call::cloth_read_vertices(scene, scene.id, &target);
}

TEST(Visible, WhatNobodySeesIsNotDrawnAndCannotBeRead) {
  Hanging scene;
  scene.show(false);
  scene.tick(10);
  EXPECT_EQ(scene.stats().invisible, 1u);
  EXPECT_EQ(read_one_vertex(scene), pleat_result{PLEAT_ERROR_ARGUMENT});
  std::uint32_t level = 7;
  EXPECT_EQ(call::cloth_suggest_level(scene, scene.id, 100.0f, &level), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(level, 7u);
#ifdef PLEAT_WITH_SMOOTHING
  for (const char* name : {"particle_normals", "edge_length", "tessellation", "drawn_normals"}) {
    EXPECT_TRUE(scene.explain(name).ends_with("left out: nobody sees the cloth")) << name;
  }
#endif
  scene.show(true);
  EXPECT_EQ(scene.stats().invisible, 0u);
  scene.vertices(scene.id);
}

TEST(Visible, BoundsAreThoseOfTheParticles) {
  Hanging scene;
  scene.show(false);
  scene.tick(20);
  float low[3], high[3];
  must(call::cloth_bounds(scene, scene.id, low, high));
  const std::vector<float> x = scene.particles(scene.id);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float least = x[axis], most = x[axis];
    for (std::size_t i = axis; i < x.size() / 2; i += 3) least = std::min(least, x[i]), most = std::max(most, x[i]);
    EXPECT_EQ(low[axis], least);
    EXPECT_EQ(high[axis], most);
  }
}

TEST(Visible, ItsSurfaceIsThereAtOnce) {
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = 5;  // as many in sight as out of it
  s.surface = Scene::default_settings().surface == PLEAT_SURFACE_FLAT ? PLEAT_SURFACE_FLAT : PLEAT_SURFACE_PN;
  Hanging hidden(s), seen(s);
  hidden.tick(3), seen.tick(3);
  hidden.show(false);
  hidden.tick(20), seen.tick(20);
  EXPECT_TRUE(same_bits(hidden.particles(hidden.id), seen.particles(seen.id)));
  hidden.show(true);
  EXPECT_TRUE(same_bits(hidden.vertices(hidden.id), seen.vertices(seen.id)));
}

TEST(Visible, SubstepsGoAtOnceAndComeBackSlowly) {
  Hanging scene;
  scene.tick(1);
  EXPECT_EQ(scene.substeps(), 12u);
  scene.show(false);
  scene.tick(1);
  EXPECT_EQ(scene.substeps(), 3u);
  scene.show(true);
  std::uint32_t before = 3;
  for (int frame = 0; frame < 52; ++frame) {
    scene.tick(1);
    EXPECT_GE(scene.substeps(), before);
    EXPECT_LE(scene.substeps(), before + 1);
    before = scene.substeps();
  }
  EXPECT_EQ(before, 12u);
}

TEST(Visible, ClothAtRestComesBackWithoutAJerk) {
  pleat_cloth_settings s = Scene::default_settings();
  s.air_damping = 2.0f;
  Hanging scene(s);
  scene.show(false);
  scene.tick(300);
  scene.show(true);
  float most = 0.0f;
  for (int frame = 0; frame < 60; ++frame) {
    const std::vector<float> before = scene.particles(scene.id);
    scene.tick(1);
    const std::vector<float> after = scene.particles(scene.id);
    for (std::size_t i = 0; i < before.size() / 2; ++i) most = std::max(most, std::abs(after[i] - before[i]));
  }
  EXPECT_LT(most, 0.01f);
}

TEST(Visible, TheBudgetTakesNothingMoreFromWhatNobodySees) {
  Hanging scene;
  scene.show(false);
  scene.tick(3);
  for (int call = 0; call < 40; ++call) must(call::world_keep_budget(scene, 1.0f, 100.0f));
  EXPECT_EQ(scene.stats().folds_given_up, 0u);
  EXPECT_EQ(scene.stats().substeps_given_up, 0u);
}

TEST(Visible, TheBudgetExchangesNothingWithWhatNobodySees) {
  Hanging scene;
  const pleat_cloth other = scene.cloth(scene.sheet(7));
  must(call::cloth_set_importance(scene, other, 5.0f));
  scene.tick(3);
  for (int call = 0; call < 40; ++call) must(call::world_keep_budget(scene, 1.0f, 100.0f));
  EXPECT_EQ(scene.stats().substeps_given_up, 2u);
  scene.show(false);
  for (int call = 0; call < 3; ++call) must(call::world_keep_budget(scene, 1.0f, 1.0f));
  EXPECT_EQ(scene.stats().substeps_given_up, 1u) << "the one that is seen";
  scene.show(true);
  EXPECT_EQ(scene.stats().substeps_given_up, 1u);
}

TEST(Visible, ClothThatSleptOutOfSightWakesWithItsSubsteps) {
  pleat_cloth_settings s = Scene::default_settings();
  s.sleep_speed = 0.01f, s.air_damping = 2.0f, s.drag_coefficient = 1.0f;
  Hanging scene(s);
  scene.show(false);
  scene.tick(600);
  ASSERT_EQ(scene.stats().sleeping, 1u);
  scene.show(true);
  scene.tick(60);
  ASSERT_EQ(scene.stats().sleeping, 1u);
  const float wind[3] = {3, 0, 0};
  must(call::world_set_wind(scene, wind));
  scene.tick(1);
  EXPECT_EQ(scene.substeps(), 12u);
}

#ifdef PLEAT_WITH_COLLISION
TEST(Visible, BodiesThatWentMeanwhileAreGoneAtOnce) {
  Hanging scene;
  std::vector<pleat_collider> balls;
  for (int k = 0; k < 3; ++k) balls.push_back(scene.sphere(0.4f * static_cast<float>(k) - 0.4f, -0.3f, 0.0f, 0.1f));
  scene.tick(2);
  scene.show(false);
  scene.tick(1);
  must(call::collider_destroy(scene, balls[0]));
  must(call::collider_destroy(scene, balls[1]));
  scene.show(true);
  const std::vector<float> shown = scene.vertices(scene.id);
  const pleat_cloth_settings s = scene.settings(scene.id);
  must(call::cloth_set(scene, scene.id, &s));  // draws anew
  EXPECT_TRUE(same_bits(shown, scene.vertices(scene.id)));
}
#endif

#ifdef PLEAT_WITH_SMOOTHING
TEST(Visible, FoldsThatWereGivenUpStayAwayAfterAStateFromBefore) {
  Hanging scene, same;
  for (Hanging* it : {&scene, &same}) {
    it->tick(1);
    for (int i = 0; i < 40; ++i) must(call::world_keep_budget(*it, 1.0f, 1000.0f));
    it->tick(20);
    ASSERT_EQ(it->inside().clothes[0].fold_share, 0.0f);
    it->show(false);
  }
  const Bytes state = scene.saved();
  EXPECT_EQ(state, same.saved());
  must(call::world_keep_budget(scene, 0.0f, 0.0f));
  scene.show(true);
  scene.tick(30);
  ASSERT_EQ(scene.inside().clothes[0].fold_share, 1.0f);
  must(scene.load(state));
  for (Hanging* it : {&scene, &same}) it->show(true), it->tick(1);
  EXPECT_TRUE(same_bits(scene.vertices(scene.id), same.vertices(same.id)));
  EXPECT_EQ(scene.saved(), same.saved());
}
#endif

TEST(Visible, NothingIsAllocated) {
  Hanging scene;
  scene.tick(3);
  const std::uint64_t before = global_allocations(), counted = scene.stats().allocations;
  for (int frame = 0; frame < 20; ++frame) {
    scene.show(frame % 2 == 0);
    scene.tick(1);
  }
  EXPECT_EQ(global_allocations(), before);
  EXPECT_EQ(scene.stats().allocations, counted);
}

}  // namespace
}  // namespace pleat
