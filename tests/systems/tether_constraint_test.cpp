#include "systems/tether_constraint.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 12;
constexpr std::uint32_t kCorners[] = {0, kSide - 1};

TetherConstraint job(Sheet& sheet, float limit = 0.0f) {
  return {.garment = &sheet.garment, .limit = limit, .position = sheet.packed.position.data()};
}

TEST(TetherConstraint, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const TetherConstraint good = job(sheet);
  ASSERT_TRUE(good.validate());
  TetherConstraint bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  for (const float value : {-0.1f, kNan}) {
    bad = good, bad.limit = value;
    EXPECT_FALSE(bad.validate());
  }
}

TEST(TetherConstraint, ClothWithinReachOfItsPinsIsLeftAlone) {
  Sheet sheet(make_grid({.rows = kSide, .columns = kSide}), kCorners);
  shake(sheet.position, sheet.count, 0.002f, 3);
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, sheet.position[i] * 0.9f);
  sheet.position.set(kCorners[0], sheet.garment.rest_position.view()[kCorners[0]] * 0.9f);
  sheet.position.set(kCorners[1], sheet.garment.rest_position.view()[kCorners[1]] * 0.9f);
  std::vector<Vec3> before;
  for (std::uint32_t i = 0; i < sheet.count; ++i) before.push_back(sheet.position[i]);
  sheet.run_packed(job(sheet));
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_EQ(sheet.position[i], before[i]) << i;
}

TEST(TetherConstraint, RunsOfLanesEndAsOneTetherAfterTheOther) {
  for (const VectorSet set : kVectorSets) {
    if (set > widest_vectors()) continue;
    Sheet sheet(make_grid({.rows = kSide, .columns = kSide}), kCorners);
    shake(sheet.position, sheet.count, 0.3f, 5);
    std::vector<Vec3> expected;
    for (std::uint32_t i = 0; i < sheet.count; ++i) expected.push_back(sheet.position[i]);
    const Garment& g = sheet.garment;
    for (std::size_t t = 0; t < g.tether_length.size(); ++t) {
      if (g.tether_particle[t] == g.slots.empty_place) continue;
      Vec3& x = expected[g.tether_particle[t]];
      const Vec3 d = expected[g.tether_pin[t]] - x;
      const float l = length(d), longest = (1.0f + 0.01f) * g.tether_length[t];
      if (l > longest) x += d * (1.0f - longest / l);
    }
    sheet.run_packed(job(sheet, 0.01f), set);
    for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_EQ(sheet.position[i], expected[i]) << i;
  }
}

TEST(TetherConstraint, BringsAFarParticleBackToTheEndOfItsTether) {
  Sheet sheet(make_grid({.rows = kSide, .columns = kSide}), kCorners);
  const std::uint32_t below = (kSide - 1) * kSide;  // along the border, straight across from the first pin
  const Vec3 pin = sheet.position[0];
  sheet.position.set(below, pin + Vec3{0, -3, 0});
  sheet.run_packed(job(sheet, 0.01f));
  EXPECT_LT(length(sheet.position[below] - pin - Vec3{0, -1.01f, 0}), 1e-5f);
  EXPECT_EQ(sheet.position[0], pin);
}

}  // namespace
}  // namespace pleat
