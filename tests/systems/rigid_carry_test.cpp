#include "systems/rigid_carry.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

const RigidMotion kJump{{1, 2, 3}, {-4, 5, 60}, {0.6f, 0, 0, 0.8f}};

struct RigidCarryTest : testing::Test {
  Sheet sheet{make_grid({.rows = 4, .columns = 4})};

  RigidCarryTest() {
    shake(sheet.velocity, sheet.count, 1.0f, 3);
    shake(sheet.force, sheet.count, 1.0f, 4);
  }
  RigidCarry job() {
    return {.motion = kJump,
            .particle_count = sheet.count,
            .position = sheet.position,
            .velocity = sheet.velocity,
            .held = sheet.force};
  }
};

TEST_F(RigidCarryTest, RefusesToRunWithAFieldMissing) {
  ASSERT_TRUE(job().validate());
  RigidCarry bad = job();
  bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.held = {};
  EXPECT_TRUE(bad.validate());
}

using RigidCarryProperty = RigidCarryTest;
TEST_F(RigidCarryProperty, KeepsTheShapeAndHowItMoves) {
  Sheet before(make_grid({.rows = 4, .columns = 4}));
  shake(before.velocity, before.count, 1.0f, 3);
  shake(before.force, before.count, 1.0f, 4);
  job().run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    for (std::uint32_t j = 0; j < i; ++j) {
      const Vec3 arm = before.position[i] - before.position[j], carried = sheet.position[i] - sheet.position[j];
      EXPECT_NEAR(length(carried), length(arm), 2e-5f);
      EXPECT_NEAR(dot(carried, sheet.velocity[j]), dot(arm, before.velocity[j]), 5e-5f);
      EXPECT_NEAR(dot(carried, sheet.force[j]), dot(arm, before.force[j]), 5e-5f);
    }
  }
}

TEST_F(RigidCarryTest, TurnsAboutOnePointAndBringsItToTheOther) {
  sheet.position.set(0, kJump.from);
  sheet.position.set(1, kJump.from + Vec3{0, 1, 0});
  job().run();
  EXPECT_EQ(sheet.position[0], kJump.to);
  EXPECT_LT(length(sheet.position[1] - (kJump.to + Vec3{0, 0.28f, 0.96f})), 1e-5f);
}

TEST(RigidMotion, OneAfterTheOther) {
  const RigidMotion second{{0, 1, 0}, {7, 0, 0}, {0, 0.28f, 0, 0.96f}}, both = kJump.then(second);
  const Vec3 p{0.3f, -2, 5};
  EXPECT_LT(length(both.apply(p) - second.apply(kJump.apply(p))), 1e-4f);
}

}  // namespace
}  // namespace pleat
