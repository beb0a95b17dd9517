#include "systems/finite_guard.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

class FiniteGuardTest : public testing::Test {
 protected:
  Sheet sheet{make_grid({.rows = 3, .columns = 3})};
  Stats stats;

  FiniteGuardTest() {
    for (std::uint32_t i = 0; i < sheet.count; ++i) {
      sheet.previous.set(i, {static_cast<float>(i), 0, 0});
      sheet.velocity.set(i, {1, 2, 3});
    }
  }
  FiniteGuard job() {
    return {.particle_count = sheet.count,
            .previous = sheet.previous,
            .position = sheet.position,
            .velocity = sheet.velocity};
  }
};

TEST_F(FiniteGuardTest, RefusesToRunWithAFieldMissing) {
  ASSERT_TRUE(job().validate());
  FiniteGuard bad = job();
  bad.previous = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.velocity = {};
  EXPECT_FALSE(bad.validate());
}

TEST_F(FiniteGuardTest, LeavesWhatIsSaneAlone) {
  sheet.position.set(0, {9e5f, 0, 0});
  sheet.velocity.set(1, {0, 9e4f, 0});
  job().run(stats);
  EXPECT_EQ(stats.nonfinite_restored, 0u);
  EXPECT_EQ(sheet.position[0], (Vec3{9e5f, 0, 0}));
  EXPECT_EQ(sheet.velocity[1], (Vec3{0, 9e4f, 0}));
}

TEST_F(FiniteGuardTest, PutsBackWhatIsNot) {
  const float bad[] = {kNan, kInfinity, -kInfinity, 2e6f, 3e38f};
  for (std::uint32_t i = 0; i < 5; ++i) sheet.position.set(i, {0, bad[i], 0});
  sheet.velocity.set(5, {kNan, 0, 0});
  sheet.velocity.set(6, {0, 0, 2e5f});
  job().run(stats);
  EXPECT_EQ(stats.nonfinite_restored, 7u);
  for (std::uint32_t i = 0; i < 7; ++i) {
    EXPECT_EQ(sheet.position[i], sheet.previous[i]) << i;
    EXPECT_EQ(sheet.velocity[i], Vec3{}) << i;
  }
  EXPECT_EQ(sheet.velocity[7], (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace pleat
