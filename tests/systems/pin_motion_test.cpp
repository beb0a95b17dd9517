#include "systems/pin_motion.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

class PinMotionTest : public testing::Test {
 protected:
  const std::uint32_t pins[2] = {3, 1};
  Sheet sheet{make_grid({.rows = 2, .columns = 2}), pins};
  Vec3Column from{std::pmr::new_delete_resource()}, to{std::pmr::new_delete_resource()};

  PinMotionTest() {
    from.resize(2), to.resize(2);
    from.view().set(0, {1, 0, 0}), to.view().set(0, {2, 0, 0});
    from.view().set(1, {0, 1, 0}), to.view().set(1, {0, 1, 4});
  }
  PinMotion job(float t0 = 0.25f, float t1 = 0.5f) {
    return {.garment = &sheet.garment,
            .pin_previous = from.view(),
            .pin_next = to.view(),
            .t0 = t0,
            .t1 = t1,
            .dt = 0.125f,
            .position = sheet.position,
            .velocity = sheet.velocity};
  }
};

TEST_F(PinMotionTest, RefusesToRunWithAFieldMissing) {
  ASSERT_TRUE(job().validate());
  PinMotion bad = job();
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.pin_previous = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.pin_next = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
  EXPECT_FALSE(job(0.5f, 0.5f).validate());
  EXPECT_FALSE(job(-0.1f, 0.5f).validate());
  EXPECT_FALSE(job(0.5f, 1.1f).validate());
}

TEST_F(PinMotionTest, PinsStandOnTheirLineAndReachTheNextPose) {
  const Vec3 free = sheet.position[0];
  job().run();
  EXPECT_EQ(sheet.position[3], (Vec3{1.25f, 0, 0}));
  EXPECT_EQ(sheet.velocity[3], (Vec3{2, 0, 0}));
  EXPECT_EQ(sheet.position[1], (Vec3{0, 1, 1}));
  EXPECT_EQ(sheet.velocity[1], (Vec3{0, 0, 8}));
  EXPECT_EQ(sheet.position[3] + sheet.velocity[3] * 0.125f, (Vec3{1.5f, 0, 0}));
  EXPECT_EQ(sheet.position[0], free);
  EXPECT_EQ(sheet.velocity[0], Vec3{});
}

}  // namespace
}  // namespace pleat
