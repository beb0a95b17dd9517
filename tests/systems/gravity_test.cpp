#include "systems/gravity.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

Gravity job(Sheet& sheet) {
  return {.particle_count = sheet.count, .mass = sheet.mass, .acceleration = {1, -9.81f, 2}, .force = sheet.force};
}

TEST(Gravity, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const Gravity good = job(sheet);
  ASSERT_TRUE(good.validate());
  Gravity bad = good;
  bad.mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.acceleration.y = kInfinity;
  EXPECT_FALSE(bad.validate());
}

TEST(Gravity, AddsTheWeightOfEachParticle) {
  Sheet sheet(make_grid({.rows = 3, .columns = 3}));
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.force.set(i, {0, 1, 0});
  job(sheet).run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    EXPECT_EQ(sheet.force[i], (Vec3{0, 1, 0} + Vec3{1, -9.81f, 2} * sheet.mass[i]));
  }
}

}  // namespace
}  // namespace pleat
