#include "systems/slow_force.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

TEST(SlowForce, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const SlowForce good{.particle_count = sheet.count, .slow = sheet.velocity, .force = sheet.force};
  ASSERT_TRUE(good.validate());
  SlowForce bad = good;
  bad.slow = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
}

TEST(SlowForce, IsAddedAndStays) {
  Sheet sheet(make_grid({.rows = 5, .columns = 5}));
  Vec3Column slow(std::pmr::new_delete_resource());
  slow.resize(sheet.count);
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    slow.view().set(i, {static_cast<float>(i), 2, -3});
    sheet.force.set(i, {0, 1, 0});
  }
  const SlowForce job{.particle_count = sheet.count, .slow = slow.view(), .force = sheet.force};
  job.run(), job.run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    EXPECT_EQ(sheet.force[i], (Vec3{2.0f * static_cast<float>(i), 5, -6}));
    EXPECT_EQ(slow.view()[i], (Vec3{static_cast<float>(i), 2, -3}));
  }
}

}  // namespace
}  // namespace pleat
