#include "engine/schedule.h"

#include <gtest/gtest.h>

#include "engine/schedule_table.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

bool runs(const std::string& line) { return line.ends_with(" run"); }

TEST(Schedule, ExplainHasALineForEachSystemInOrder) {
  Scene scene;
  std::vector<std::string> lines;
  must(call::world_explain(
      scene, [](const char* line, void* user) { static_cast<std::vector<std::string>*>(user)->push_back(line); },
      &lines));
  ASSERT_GE(lines.size(), schedule_table().size());
  for (std::size_t r = 0; r < schedule_table().size(); ++r) {
    EXPECT_TRUE(lines[r].starts_with(std::string(schedule_table()[r].name) + " ")) << lines[r];
    EXPECT_NE(lines[r].find("left out: no cloth"), std::string::npos) << lines[r];
  }
}

TEST(Schedule, EveryRowIsOfItsPhaseAlone) {
  for (std::size_t r = 0; r < schedule_table().size(); ++r) {
    for (std::size_t phase = 0; phase < kPhases; ++phase) {
      const bool own = schedule_table()[r].phase == static_cast<Phase>(phase);
      EXPECT_EQ((rows_of(static_cast<Phase>(phase)) >> r & 1) != 0, own) << schedule_table()[r].name;
    }
  }
}

TEST(Schedule, PhasesOfTheTableNeverGoBack) {
  for (std::size_t r = 1; r < schedule_table().size(); ++r) {
    EXPECT_LE(schedule_table()[r - 1].phase, schedule_table()[r].phase) << schedule_table()[r].name;
  }
}

TEST(Schedule, SettingsOfZeroLeaveTheirSystemOutAndSayWhy) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4));
  for (const char* name :
       {"pin_motion", "edge_ways", "elastic_projection", "hinge_bending", "gravity", "air_damping", "inner_friction",
        "euler_integration", "stretch_constraint", "velocity_update", "finite_guard", "rounding_hold"}) {
    EXPECT_TRUE(runs(scene.explain(name))) << scene.explain(name);
  }
  EXPECT_TRUE(scene.explain("elastic_force").ends_with("left out: edges are projected"));
  EXPECT_TRUE(scene.explain("edge_damping").ends_with("left out: edges are projected"));
  EXPECT_TRUE(scene.explain("air_drag").ends_with("left out: drag_coefficient and lift_coefficient are 0"));
  EXPECT_TRUE(scene.explain("tether_constraint").ends_with("left out: no particle is far from a pin"));
  EXPECT_TRUE(scene.explain("runge_kutta_integration").ends_with("left out: another integrator"));

  pleat_cloth_settings s = scene.settings(cloth);
  s.stiffness = s.bend_stiffness = s.bend_damping = s.edge_damping = s.air_damping = s.inner_friction = 0.0f;
  s.stretch_limit = 1.0f;
  s.drag_coefficient = 1.0f;
  s.surface = PLEAT_SURFACE_FLAT;
  must(call::cloth_set(scene, cloth, &s));
  EXPECT_TRUE(scene.explain("elastic_projection").ends_with("left out: stiffness is 0"));
  EXPECT_TRUE(scene.explain("hinge_bending").ends_with("left out: bend_stiffness is 0"));
  EXPECT_TRUE(scene.explain("edge_damping").ends_with("left out: edge_damping is 0"));
  EXPECT_TRUE(scene.explain("air_damping").ends_with("left out: air_damping is 0"));
  EXPECT_TRUE(scene.explain("inner_friction").ends_with("left out: inner_friction is 0"));
  EXPECT_TRUE(scene.explain("rounding_hold").ends_with("left out: inner_friction is 0"));
  EXPECT_TRUE(scene.explain("stretch_constraint").ends_with("left out: stretch_limit is 1 or more"));
  EXPECT_TRUE(runs(scene.explain("air_drag")));
  s.edge_damping = 1.0f;
  must(call::cloth_set(scene, cloth, &s));
  EXPECT_TRUE(runs(scene.explain("edge_damping")));
#ifdef PLEAT_WITH_SMOOTHING
  EXPECT_TRUE(scene.explain("particle_normals").ends_with("left out: flat surface"));
#endif
}

TEST(Schedule, TellsHowManyClothsRunASystem) {
  Scene scene;
  const pleat_garment sheet = scene.sheet(3);
  pleat_cloth_settings s = Scene::default_settings();
  scene.cloth(sheet, s);
  s.stiffness = 0.0f;
  scene.cloth(sheet, s);
  EXPECT_TRUE(
      scene.explain("elastic_projection").ends_with("run for 1 of 2 cloths, left out of the others: stiffness is 0"))
      << scene.explain("elastic_projection");
}

TEST(Schedule, GravityIsPlannedAnewWhenItChanges) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(3));
  const float none[3] = {0, 0, 0}, side[3] = {5, 0, 0};
  must(call::world_set_gravity(scene, none));
  EXPECT_TRUE(scene.explain("gravity").ends_with("left out: gravity is 0"));
  const std::vector<float> before = scene.particles(cloth);
  scene.step();
  EXPECT_TRUE(same_bits(scene.particles(cloth), before));
  must(call::world_set_gravity(scene, side));
  scene.step();
  EXPECT_FALSE(same_bits(scene.particles(cloth), before));
}

#ifdef PLEAT_WITH_COLLISION
TEST(Schedule, WithoutAColliderThereAreNoContactColumns) {
  Scene scene;
  scene.cloth(scene.sheet(8));
  scene.step(3);
  for (const char* name : {"contact_acceleration", "collider_motion", "capsule_candidates", "capsule_detection",
                           "mesh_detection", "collision_response", "contact_friction", "stretch_after_friction",
                           "contact_stick", "collision_last_word", "contact_velocity"}) {
    EXPECT_TRUE(scene.explain(name).ends_with("left out: no collider")) << scene.explain(name);
  }
  World& world = scene.inside();
  EXPECT_EQ(world.workers[0].contacts.size(), 0u);
  EXPECT_EQ(world.workers[0].capsule_poses.size(), 0u);
  EXPECT_EQ(world.workers[0].capsule_candidates.near.size(), 0u);
  EXPECT_EQ(world.bodies, nullptr);
}

TEST(Schedule, BodiesThatChangeNoPlanAreRightlyNotPlannedFor) {
  Scene scene;
  scene.cloth(scene.sheet(4));
  World& world = scene.inside();
  const auto expect_what_a_full_plan_says = [&] {
    EXPECT_GE(world.workers[0].capsule_poses.size(), world.capsules.size());
    const Plan plan = world.clothes[0].plan;
    replan(world);
    EXPECT_EQ(plan, world.clothes[0].plan) << world.capsules.size() << " capsules";
  };
  std::vector<pleat_collider> spheres;
  for (int k = 0; k < 9; ++k) {
    spheres.push_back(scene.sphere(static_cast<float>(k), -1, 0, 0.2f));
    expect_what_a_full_plan_says();
    scene.step();
    EXPECT_EQ(world.stats.contacts_dropped, 0u);
  }
  for (const pleat_collider sphere : spheres) {
    must(call::collider_destroy(scene, sphere));
    expect_what_a_full_plan_says();
  }
}

TEST(Schedule, CollidersArePlannedAnewWhenTheyComeAndGo) {
  Scene scene;
  scene.cloth(scene.sheet(4));
  const pleat_collider sphere = scene.sphere(0, -1, 0, 0.2f);
  EXPECT_TRUE(runs(scene.explain("capsule_detection")));
  EXPECT_TRUE(runs(scene.explain("collision_response")));
  EXPECT_TRUE(scene.explain("mesh_detection").ends_with("left out: no mesh body"));
  EXPECT_TRUE(scene.explain("mesh_clearance").ends_with("left out: no mesh body"));
  EXPECT_GT(scene.inside().workers[0].contacts.size(), 0u);
  scene.step();
  must(call::collider_destroy(scene, sphere));
  EXPECT_TRUE(scene.explain("capsule_detection").ends_with("left out: no collider"));
  EXPECT_EQ(scene.inside().bodies, nullptr);
  scene.step();
}
#endif

TEST(Schedule, RungeKuttaColumnsExistOnlyWhereAskedFor) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4));
  scene.step();
  EXPECT_EQ(scene.inside().runge_kutta.start_velocity.size(), 0u);
  pleat_cloth_settings s = scene.settings(cloth);
  s.integrator = PLEAT_INTEGRATOR_RUNGE_KUTTA_4;
  must(call::cloth_set(scene, cloth, &s));
  EXPECT_EQ(scene.inside().runge_kutta.start_velocity.size(), padded(16));
  EXPECT_TRUE(runs(scene.explain("runge_kutta_integration")));
  EXPECT_TRUE(scene.explain("euler_integration").ends_with("left out: another integrator"));
  scene.step();
}

#ifdef PLEAT_WITH_SMOOTHING
TEST(Schedule, SurfaceColumnsExistOnlyWhereDrawnCurved) {
  Scene scene;
  const pleat_garment sheet = scene.sheet(4);
  pleat_cloth_settings s = Scene::default_settings();
  s.surface = PLEAT_SURFACE_FLAT;
  scene.cloth(sheet, s);
  EXPECT_EQ(scene.inside().surface.normal.size(), 0u);
  s.surface = PLEAT_SURFACE_PN;
  scene.cloth(sheet, s);
  EXPECT_EQ(scene.inside().surface.normal.size(), 2 * padded(16));
  EXPECT_EQ(scene.inside().surface.fold.size(), 0u);
  s.surface = PLEAT_SURFACE_PLEAT;
  scene.cloth(sheet, s);
  EXPECT_EQ(scene.inside().surface.fold.size(), 3 * padded(33));
  EXPECT_TRUE(scene.explain("edge_length").find("run for 1 of 3 cloths") != std::string::npos);
}

TEST(Schedule, FoldsAreRelaxedOnlyWhereAskedFor) {
  Scene scene;
  const pleat_garment sheet = scene.sheet(4);
  const pleat_cloth cloth = scene.cloth(sheet);
  EXPECT_TRUE(scene.explain("fold_relaxation").ends_with("left out: fold_sweeps = 0"));
  EXPECT_EQ(scene.inside().workers[0].fold_scratch.freedom.size(), 0u);
  pleat_cloth_settings s = scene.settings(cloth);
  s.fold_sweeps = 4, s.surface = PLEAT_SURFACE_PAPER;
  must(call::cloth_set(scene, cloth, &s));
  EXPECT_TRUE(scene.explain("fold_relaxation").ends_with("left out: folds of another surface, or none"));
  EXPECT_EQ(scene.inside().workers[0].fold_scratch.freedom.size(), 0u);
  s.surface = PLEAT_SURFACE_PLEAT;
  must(call::cloth_set(scene, cloth, &s));
  EXPECT_TRUE(runs(scene.explain("fold_relaxation")));
  EXPECT_EQ(scene.inside().workers[0].fold_scratch.freedom.size(), 33u);
  scene.step();
}
#endif

TEST(Schedule, StageCallbackBracketsEverySystemThatRuns) {
  struct Seen {
    int depth = 0;
    std::string open;
    std::vector<std::string> names;
  } seen;
  pleat_world_def def = Scene::default_def();
  def.stage_user = &seen;
  def.stage = [](const char* system, int begin, void* user) {
    Seen& s = *static_cast<Seen*>(user);
    s.depth += begin ? 1 : -1;
    EXPECT_TRUE(s.depth == 0 || s.depth == 1);
    if (begin) {
      s.open = system;
      s.names.push_back(system);
    } else {
      EXPECT_EQ(s.open, system);
    }
  };
  Scene scene(def);
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = 2;
  s.sweeps = 3;
  scene.cloth(scene.sheet(3), s);
  seen.names.clear();
  scene.step();
  EXPECT_EQ(seen.depth, 0);
  EXPECT_EQ(std::count(seen.names.begin(), seen.names.end(), "elastic_projection"), 2);
  EXPECT_EQ(std::count(seen.names.begin(), seen.names.end(), "stretch_constraint"), 6);
  EXPECT_EQ(std::count(seen.names.begin(), seen.names.end(), "air_drag"), 0);
  EXPECT_EQ(std::count(seen.names.begin(), seen.names.end(), "body_refit"), 0);
#ifdef PLEAT_WITH_COLLISION
  scene.sphere(0, -9, 0, 0.2f);
  seen.names.clear();
  scene.step();
  EXPECT_EQ(seen.depth, 0);
  EXPECT_EQ(std::count(seen.names.begin(), seen.names.end(), "body_refit"), 1) << "once a tick, not once a cloth";
#endif
}

TEST(Schedule, SubstepsFollowTheLongestInternalStep) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(3));
  scene.step(1, 1.0f / 60);
  EXPECT_EQ(scene.info(cloth).substeps, 6u);
  scene.step(1, 1.0f / 30);
  EXPECT_EQ(scene.info(cloth).substeps, 12u);
  scene.step(1, 1.0f);
  EXPECT_EQ(scene.info(cloth).substeps, 64u);
  scene.step(1, 1e-5f);
  EXPECT_EQ(scene.info(cloth).substeps, 1u);
  EXPECT_EQ(scene.stats().substeps, 83u);
  EXPECT_EQ(scene.stats().ticks, 4u);
}

TEST(Schedule, StiffSpringsGetMoreSubstepsAndSayWhenTheyNeedTooMany) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  s.integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
  s.stiffness = 30.0f;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4), s);
  scene.step(1, 1.0f / 60);
  EXPECT_EQ(scene.info(cloth).substeps, 6u);
  s.stiffness = 2000.0f;
  must(call::cloth_set(scene, cloth, &s));
  scene.step(1, 1.0f / 60);
  const std::uint32_t stiff = scene.info(cloth).substeps;
  EXPECT_GT(stiff, 6u);
  EXPECT_LT(stiff, 24u);
  EXPECT_EQ(scene.stats().stiffness_lowered, 0u);
  s.stiffness = 1e9f;
  must(call::cloth_set(scene, cloth, &s));
  scene.step(3, 1.0f / 60);
  EXPECT_EQ(scene.info(cloth).substeps, 24u);
  EXPECT_EQ(scene.stats().stiffness_lowered, 3u);
  s.integrator = PLEAT_INTEGRATOR_PROJECTED;  // stable as it is
  must(call::cloth_set(scene, cloth, &s));
  scene.step(1, 1.0f / 60);
  EXPECT_EQ(scene.info(cloth).substeps, 6u);
  s.integrator = PLEAT_INTEGRATOR_IMPLICIT_EULER;
  must(call::cloth_set(scene, cloth, &s));
  scene.step(1, 1.0f / 60);
  EXPECT_EQ(scene.info(cloth).substeps, 2u);
  EXPECT_EQ(scene.stats().stiffness_lowered, 3u);
}

TEST(Schedule, StiffBendingActsInShorterStepsBeforeItTakesMoreSubsteps) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
  const auto substeps_at = [&](float bend_stiffness) {
    s.bend_stiffness = bend_stiffness;
    must(call::cloth_set(scene, cloth, &s));
    scene.step(1, 1.0f / 60);
    return scene.info(cloth).substeps;
  };
  float carried = 5e-5f;  // N m, that six substeps carry in one piece: an explicit integrator takes no more of them
  s.integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
  s.stiffness = 0.0f;
  while (substeps_at(1.1f * carried) == 6u) carried *= 1.1f;
  s.integrator = PLEAT_INTEGRATOR_PROJECTED;
  s.stiffness = 335.0f;
  EXPECT_EQ(substeps_at(10.0f * carried), 6u);  // four times shorter steps carry sixteen times as much
  const std::uint32_t more = substeps_at(40.0f * carried);
  EXPECT_TRUE(more > 6u && more <= 12u) << more;
  EXPECT_EQ(scene.stats().stiffness_lowered, 0u);
  EXPECT_EQ(substeps_at(1e4f * carried), 24u);
  EXPECT_EQ(scene.stats().stiffness_lowered, 1u);
}

}  // namespace
}  // namespace pleat
