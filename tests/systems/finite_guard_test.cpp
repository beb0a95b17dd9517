#include "systems/finite_guard.h"

#include <gtest/gtest.h>

#include "components/limits.h"
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
  const Vec3 far{kFarthest, -kFarthest, kFarthest}, fast{-kFastest, kFastest, -kFastest};  // what the border lets in
  sheet.position.set(0, far);
  sheet.velocity.set(1, fast);
  job().run(stats);
  EXPECT_EQ(stats.nonfinite_restored, 0u);
  EXPECT_EQ(sheet.position[0], far);
  EXPECT_EQ(sheet.velocity[1], fast);
}

TEST_F(FiniteGuardTest, PutsBackWhatIsNot) {
  const float bad[] = {kNan, kInfinity, -kInfinity, std::nextafter(kFarthest, kInfinity), 3e38f};
  for (std::uint32_t i = 0; i < 5; ++i) sheet.position.set(i, {0, bad[i], 0});
  sheet.velocity.set(5, {kNan, 0, 0});
  sheet.velocity.set(6, {0, 0, std::nextafter(-kFastest, -kInfinity)});
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
