#include "systems/velocity_update.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

VelocityUpdate job(Sheet& sheet) {
  return {.particle_count = sheet.count,
          .position = sheet.position,
          .predicted = sheet.predicted,
          .inverse_mass = sheet.inverse_mass,
          .dt = 0.25f,
          .velocity = sheet.velocity};
}

TEST(VelocityUpdate, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const VelocityUpdate good = job(sheet);
  ASSERT_TRUE(good.validate());
  VelocityUpdate bad = good;
  bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.predicted = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(VelocityUpdate, AddsWhatTheConstraintsMovedButNotToPins) {
  const std::uint32_t pins[] = {1};
  Sheet sheet(make_grid({.rows = 2, .columns = 2}), pins);
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    sheet.velocity.set(i, {1, 1, 1});
    sheet.predicted.set(i, sheet.position[i] - Vec3{0.5f, 0, -0.25f});
  }
  job(sheet).run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    EXPECT_EQ(sheet.velocity[i], (i == 1 ? Vec3{1, 1, 1} : Vec3{3, 1, 0})) << i;
  }
}

}  // namespace
}  // namespace pleat
