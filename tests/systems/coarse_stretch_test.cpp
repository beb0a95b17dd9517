#include "systems/coarse_stretch.h"

#include <gtest/gtest.h>

#include "systems/stretch_constraint.h"
#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 48;
constexpr std::uint32_t kCorners[] = {0, kSide - 1};

CoarseStretch job(Sheet& sheet) {
  return {.garment = &sheet.garment,
          .limit = 0.01f,
          .way = sheet.ways(),
          .position = &sheet.packed.position,
          .begin = &sheet.packed.begin};
}
StretchConstraint pass(Sheet& sheet) {
  return {.slots = &sheet.garment.slots, .limit = 0.01f, .way = sheet.ways(), .position = &sheet.packed.position};
}

/// A sheet that hangs from two corners, longer than it is by `share`.
Sheet stretched(float share) {
  Sheet sheet(make_grid({.rows = kSide, .columns = kSide}), kCorners);
  const ConstVec3View rest = sheet.garment.rest_position.view();
  const Vec3 pin = rest[0];
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    const Vec3 x = rest[i];
    sheet.position.set(i, {x.x, x.y, pin.z + (x.z - pin.z) * (1.0f + share)});
    sheet.previous.set(i, sheet.position[i]);
  }
  return sheet;
}

float hem(const Sheet& sheet) {
  return std::abs(sheet.position[kSide * (kSide - 1) + kSide / 2].z - sheet.position[0].z);
}

TEST(CoarseStretch, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const CoarseStretch good = job(sheet);
  ASSERT_TRUE(good.validate());
  CoarseStretch bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.way = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.begin = nullptr;
  EXPECT_FALSE(bad.validate());
  for (const float value : {-0.1f, kNan}) {
    bad = good, bad.limit = value;
    EXPECT_FALSE(bad.validate());
  }
  for (const float value : {0.0f, 2.0f, kNan}) {
    bad = good, bad.relaxation = value;
    EXPECT_FALSE(bad.validate());
  }
}

TEST(CoarseStretch, ClothWithinItsLimitIsLeftAlone) {
  Sheet sheet = stretched(0.005f);
  std::vector<Vec3> before;
  for (std::uint32_t i = 0; i < sheet.count; ++i) before.push_back(sheet.position[i]);
  Stats stats;
  sheet.run_packed(job(sheet), stats);
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_EQ(sheet.position[i], before[i]) << i;
}

TEST(CoarseStretch, PullsAFarHemUpSeveralTimesAsFarInTheSameTime) {
  constexpr float kShare = 0.1f;
  Sheet passes = stretched(kShare), levels = stretched(kShare);
  const float begin = hem(passes);
  Stats stats;
  const CoarseStretch first = job(levels);
  const StretchConstraint then = pass(levels), only = pass(passes);
  for (int sweep = 0; sweep < 4; ++sweep) {
    levels.run_packed(first, stats), levels.run_packed(then, stats);
    passes.run_packed(only, stats), passes.run_packed(only, stats);
  }
  EXPECT_GT(begin - hem(levels), 2.5f * (begin - hem(passes)));
}

TEST(CoarseStretch, PinsHoldAndAllVectorSetsGiveTheSameBits) {
  std::vector<Vec3> expected;
  for (const VectorSet set : kVectorSets) {
    if (set > widest_vectors()) continue;
    Sheet sheet = stretched(0.05f);
    shake(sheet.position, sheet.count, 0.01f, 7);
    const Vec3 pins[] = {sheet.position[kCorners[0]], sheet.position[kCorners[1]]};
    Stats stats;
    sheet.run_packed(job(sheet), stats, set);
    EXPECT_EQ(sheet.position[kCorners[0]], pins[0]);
    EXPECT_EQ(sheet.position[kCorners[1]], pins[1]);
    for (std::uint32_t i = 0; i < sheet.count; ++i) {
      if (set == VectorSet::kBaseline) expected.push_back(sheet.position[i]);
      EXPECT_EQ(sheet.position[i], expected[i]) << i;
    }
  }
}

TEST(CoarseStretch, WhatAnotherClothLeftInEmptyPlacesGoesNowhere) {
  Sheet sheet = stretched(0.05f);
  const CoarseStretch good = job(sheet);
  for (const std::uint32_t k : {0u, 1u}) {
    sheet.packed.position[sheet.garment.slots.empty_place + k] = {kNan, kNan, kNan, 1.0f};
  }
  Stats stats;
  sheet.run_packed(good, stats);
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_TRUE(is_finite(sheet.position[i])) << i;
}

TEST(CoarseStretch, SurvivesACollapsedCloth) {
  Sheet sheet = stretched(0.0f);
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, {0, 0, 0}), sheet.previous.set(i, {0, 0, 0});
  sheet.position.set(sheet.count - 1, {100, 0, 0});
  Stats stats;
  sheet.run_packed(job(sheet), stats);
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_TRUE(is_finite(sheet.position[i])) << i;
  EXPECT_GT(stats.edges_skipped, 0u);
}

}  // namespace
}  // namespace pleat
