#include "systems/substep_bound.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kDt = 1.0f / 30, kRadius = 0.045f, kThickness = 0.005f;

/// A sheet of 1 m2 in the plane y = 0 and one capsule along z that goes from `from` to `to` in a tick.
struct Crossing {
  Sheet sheet{make_grid({.rows = 4, .columns = 4})};
  CapsuleColumns capsules{std::pmr::new_delete_resource()};
  CollisionBodies bodies{std::pmr::new_delete_resource()};

  Crossing(const Vec3& from, const Vec3& to) {
    for (Vec3Column* column : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
      column->resize(1);
    }
    for (Column<float>* column : {&capsules.radius, &capsules.taper, &capsules.thickness, &capsules.friction})
      column->resize(1);
    capsules.enabled.resize(1);
    capsules.enabled[0] = 1;
    capsules.radius[0] = kRadius;
    const Vec3 half{0, 0, 0.3f};
    capsules.previous_a.view().set(0, from - half), capsules.previous_b.view().set(0, from + half);
    capsules.next_a.view().set(0, to - half), capsules.next_b.view().set(0, to + half);
    set_velocity({});
  }
  void set_velocity(const Vec3& v) {
    for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.velocity.set(i, v);
  }
  SubstepBound job() {
    bodies.update_capsules(capsules);
    return {.particle_count = sheet.count,
            .position = sheet.position,
            .velocity = sheet.velocity,
            .capsules = &capsules,
            .bodies = &bodies,
            .thickness = kThickness,
            .dt = kDt};
  }
};

TEST(SubstepBound, RefusesToRunWithAFieldMissing) {
  Crossing c({0, 0.2f, 0}, {0, -0.2f, 0});
  const SubstepBound good = c.job();
  ASSERT_TRUE(good.validate());
  SubstepBound bad = good;
  bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.capsules = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.bodies = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(SubstepBound, HalfTheRadiusASubstep) {
  EXPECT_EQ(Crossing({0, 0.2f, 0}, {0, -0.19f, 0}).job().run(), 16u);  // .39 m in steps of .025 m
  EXPECT_EQ(Crossing({0, 0.2f, 0}, {0, 0.2f, 0}).job().run(), 1u);
}

TEST(SubstepBound, BodiesFarAwayDisabledOrCarryingTheClothAskForNothing) {
  EXPECT_EQ(Crossing({5, 0.2f, 0}, {5, -0.2f, 0}).job().run(), 1u);
  Crossing disabled({0, 0.2f, 0}, {0, -0.2f, 0});
  disabled.capsules.enabled[0] = 0;
  EXPECT_EQ(disabled.job().run(), 1u);
  Crossing carrying({0, 0.2f, 0}, {0, -0.2f, 0});
  carrying.set_velocity(Vec3{0, -0.4f, 0} * (1.0f / kDt));
  EXPECT_EQ(carrying.job().run(), 1u);
}

TEST(SubstepBound, MovingClothCountsToo) {
  Crossing c({0, 0.1f, 0}, {0, 0.1f, 0});
  c.sheet.velocity.set(5, {0, 0.16f * 30.0f, 0});  // the mean of 16 particles moves .01 m, this one .15 m more
  EXPECT_EQ(c.job().run(), 7u);                    // .16 m in steps of .025 m
}

TEST(SubstepBound, AnyMotionHasAnAnswer) {
  Crossing c({0, 0, 0}, {1e9f, 0, 0});
  c.capsules.radius[0] = 0.0f;
  SubstepBound job = c.job();
  job.thickness = 0.0f;
  EXPECT_EQ(job.run(), SubstepBound::kMost);
}

TEST(SubstepBound, AMeshAsFarAsItsFeaturesAreLookedFor) {
  Crossing c({0, 5, 0}, {0, 5, 0});
  MeshCollider ball(std::pmr::new_delete_resource());
  ball.previous.resize(1), ball.next.resize(1);
  const MeshCollider* const meshes[] = {&ball};
  SubstepBound job = c.job();
  job.meshes = meshes, job.mesh_count = 1;
  const auto go = [&](const Vec3& from, const Vec3& to) {
    ball.previous.view().set(0, from), ball.next.view().set(0, to);
    return job.run();
  };
  EXPECT_EQ(go({0, 0.2f, 0}, {0, -0.2f, 0}), 27u);  // .4 m in steps of .015 m
  EXPECT_EQ(go({0, 0.2f, 0}, {0, 0.2f, 0}), 1u);
  EXPECT_EQ(go({5, 0.2f, 0}, {5, -0.2f, 0}), 1u);  // beside the cloth
  c.set_velocity({0, -12, 0});
  EXPECT_EQ(go({0, 0.2f, 0}, {0, -0.2f, 0}), 1u);  // carries it along
  ball.enabled = false;
  c.set_velocity({});
  EXPECT_EQ(go({0, 0.2f, 0}, {0, -0.2f, 0}), 1u);
}

}  // namespace
}  // namespace pleat
