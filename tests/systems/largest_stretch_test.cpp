#include "systems/largest_stretch.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

LargestStretch job(Sheet& s) { return {.garment = &s.garment, .position = s.position, .inverse_mass = s.inverse_mass}; }

TEST(LargestStretch, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 3, .columns = 3}));
  const LargestStretch good = job(sheet);
  ASSERT_TRUE(good.validate());
  LargestStretch bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
}

TEST(LargestStretch, IsThatOfTheLongestEdgeWhichCanGiveWay) {
  static constexpr std::uint32_t kPins[] = {0, 1};
  Sheet sheet({{{0, 0, 0}, {2, 0, 0}, {1, 0, -1}}, {{0, 1, 2}}}, kPins);
  EXPECT_EQ(job(sheet).run(), 0.0f);
  sheet.position.set(1, {3, 0, 0});  // between two pins: theirs
  sheet.position.set(2, {1.5f, 0, -0.5f});
  EXPECT_NEAR(job(sheet).run(), std::sqrt(2.5f / 2.0f) - 1.0f, 1e-6f);
  sheet.position.set(2, {1.5f, 0, 0});
  sheet.position.set(1, {2, 0, 0});
  EXPECT_NEAR(job(sheet).run(), 1.5f / std::sqrt(2.0f) - 1.0f, 1e-6f);
}

}  // namespace
}  // namespace pleat
