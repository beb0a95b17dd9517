#include "systems/air_damping.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

AirDamping job(Sheet& sheet, float rate, float dt = 1.0f / 60) {
  return {.particle_count = sheet.count,
          .mass = sheet.mass,
          .velocity = sheet.velocity,
          .rate = rate,
          .dt = dt,
          .force = sheet.force};
}

TEST(AirDamping, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const AirDamping good = job(sheet, 0.1f);
  ASSERT_TRUE(good.validate());
  AirDamping bad = good;
  bad.mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.rate = -1.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(AirDamping, MotionDiesAtTheRate) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  sheet.velocity.set(0, {3, -4, 5});
  const float dt = 1e-3f, rate = 2.0f;
  for (int step = 0; step < 1000; ++step) {
    sheet.clear_force();
    job(sheet, rate, dt).run();
    sheet.velocity.add(0, sheet.force[0] * (dt * sheet.inverse_mass[0]));
  }
  EXPECT_NEAR(length(sheet.velocity[0]) / length(Vec3{3, -4, 5}), std::exp(-2.0f), 3e-3f * std::exp(-2.0f));
}

TEST(AirDamping, NeverReversesMotionAtAnyRate) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  sheet.velocity.set(0, {1, 0, 0});
  job(sheet, 1e6f).run();
  EXPECT_NEAR(1.0f + sheet.force[0].x * sheet.inverse_mass[0] / 60, 0.5f, 1e-5f);
}

}  // namespace
}  // namespace pleat
