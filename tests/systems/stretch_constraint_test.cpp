#include "systems/stretch_constraint.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

StretchConstraint job(Sheet& sheet, float limit = 0.001f) {
  return {.slots = &sheet.garment.slots, .limit = limit, .way = sheet.ways(), .position = &sheet.packed.position};
}

float worst_strain(const Sheet& sheet) {
  const Garment& g = sheet.garment;
  float worst = -1.0f;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const float l = length(sheet.position[g.edge_particle[1][e]] - sheet.position[g.edge_particle[0][e]]);
    worst = std::max(worst, l / g.edge_rest_length[e] - 1.0f);
  }
  return worst;
}

TEST(StretchConstraint, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const StretchConstraint good = job(sheet);
  ASSERT_TRUE(good.validate());
  StretchConstraint bad = good;
  bad.slots = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.way = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = nullptr;
  EXPECT_FALSE(bad.validate());
  Column<Vec4> small(std::pmr::new_delete_resource());
  bad = good, bad.position = &small;
  EXPECT_FALSE(bad.validate());
  for (const float value : {0.0f, 2.0f, kNan}) {
    bad = good, bad.relaxation = value;
    EXPECT_FALSE(bad.validate());
  }
  for (const float value : {-0.1f, kNan}) {
    bad = good, bad.limit = value;
    EXPECT_FALSE(bad.validate());
  }
}

TEST(StretchConstraint, PassesConvergeToTheLimit) {
  Sheet sheet(make_grid({.rows = 6, .columns = 6}));
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, sheet.position[i] * 1.2f);
  Stats stats;
  for (int pass = 0; pass < 400; ++pass) sheet.run_packed(job(sheet, 0.01f), stats);
  EXPECT_LT(worst_strain(sheet), 0.011f);
  EXPECT_EQ(stats.edges_skipped, 0u);
}

TEST(StretchConstraint, PullsThroughManyEdgesInFewerPassesWhenItPullsTooFar) {
  const auto left = [](float relaxation) {
    Sheet sheet(make_grid({.rows = 24, .columns = 4, .width = 0.3f, .depth = 2.3f}));
    for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, sheet.position[i] * 1.1f);
    Stats stats;
    for (int pass = 0; pass < 60; ++pass) {
      StretchConstraint constraint = job(sheet);
      if (pass < 57) constraint.relaxation = relaxation;
      sheet.run_packed(constraint, stats);
    }
    return worst_strain(sheet);
  };
  EXPECT_GT(left(1.0f), 0.005f);
  EXPECT_LT(left(1.6f), 0.5f * left(1.0f));
}

TEST(StretchConstraint, OverlongEdgeComesToTheLimitExactly) {
  Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -5}}, {{0, 1, 2}}});
  sheet.position.set(0, {-0.5f, 0, 0});
  sheet.position.set(2, {0.5f, 0, -4});  // slack
  Stats stats;
  sheet.run_packed(job(sheet, 0.1f), stats);
  EXPECT_FLOAT_EQ(sheet.position[1].x - sheet.position[0].x, 1.1f);
}

TEST(StretchConstraint, KeepsMomentum) {
  Sheet sheet(make_grid({.rows = 6, .columns = 6}));
  shake(sheet.position, sheet.count, 0.1f, 1);
  for (std::uint32_t i = 0; i < sheet.count; i += 3) sheet.mass[i] *= 5.0f, sheet.inverse_mass[i] /= 5.0f;
  Vec3d moved;
  double size = 0.0;
  const Sheet before = [&] {
    Sheet copy(make_grid({.rows = 6, .columns = 6}));
    for (std::uint32_t i = 0; i < sheet.count; ++i) copy.position.set(i, sheet.position[i]);
    return copy;
  }();
  Stats stats;
  sheet.run_packed(job(sheet), stats);
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    const Vec3d shift = (wide(sheet.position[i]) - wide(before.position[i])) * static_cast<double>(sheet.mass[i]);
    moved += shift;
    size += length(shift);
  }
  EXPECT_GT(size, 1e-3);
  EXPECT_LT(length(moved), 1e-5 * size);
}

TEST(StretchConstraint, SinglePullIsCentralAndKeepsAngularMomentum) {
  Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -5}}, {{0, 1, 2}}});
  sheet.inverse_mass[0] = 1.0f, sheet.inverse_mass[1] = 3.0f;
  const Vec3 a{-1, 2, 0.5f}, b{0.7f, 2.4f, -1};
  sheet.position.set(0, a);
  sheet.position.set(1, b);
  sheet.position.set(2, (a + b) * 0.5f);  // slack
  Stats stats;
  sheet.run_packed(job(sheet), stats);
  const Vec3 da = sheet.position[0] - a, db = sheet.position[1] - b;
  EXPECT_LT(length(da * 3.0f + db), 1e-5f);
  EXPECT_LT(length(cross(da, b - a)), 1e-5f);
}

TEST(StretchConstraint, PinsStayAndTheOtherEndTakesAll) {
  const std::uint32_t pins[] = {0};
  Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -5}}, {{0, 1, 2}}}, pins);
  sheet.position.set(1, {2, 0, 0});
  sheet.position.set(2, {0.5f, 0, -3});
  Stats stats;
  sheet.run_packed(job(sheet, 0.0f), stats);
  EXPECT_EQ(sheet.position[0], Vec3{});
  EXPECT_FLOAT_EQ(sheet.position[1].x, 1.0f);

  const std::uint32_t all[] = {0, 1, 2};
  Sheet held({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -5}}, {{0, 1, 2}}}, all);
  held.position.set(1, {9, 0, 0});
  held.run_packed(job(held), stats);
  EXPECT_EQ(held.position[1], (Vec3{9, 0, 0}));
}

TEST(StretchConstraint, PullsAlongTheEdgeAsTheStepBegan) {
  const std::uint32_t pins[] = {0};
  Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -5}}, {{0, 1, 2}}}, pins);
  sheet.previous.set(1, {1, 0, 0});
  sheet.position.set(1, {1, 0.2f, 0});
  sheet.position.set(2, {0.5f, 0, -4.5f});  // slack
  Stats stats;
  for (int pass = 0; pass < 5; ++pass) sheet.run_packed(job(sheet, 0.0f), stats);
  EXPECT_EQ(sheet.position[1].y, 0.2f);
  EXPECT_NEAR(length(sheet.position[1]), 1.0f, 1e-6f);
  // Turned by more than 30 degrees there is nothing to gain.
  sheet.previous.set(1, {1, 0, 0});
  sheet.position.set(1, {0.5f, 1.2f, 0});
  sheet.run_packed(job(sheet, 0.0f), stats);
  EXPECT_NEAR(sheet.position[1].y / sheet.position[1].x, 2.4f, 1e-5f);
}

TEST(StretchConstraint, SlackEdgesAreLeftAlone) {
  Sheet sheet(make_grid({.rows = 4, .columns = 4}));
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, sheet.position[i] * 0.7f);
  shake(sheet.position, sheet.count, 0.01f, 5);
  std::vector<Vec3> before;
  for (std::uint32_t i = 0; i < sheet.count; ++i) before.push_back(sheet.position[i]);
  Stats stats;
  sheet.run_packed(job(sheet), stats);
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_EQ(sheet.position[i], before[i]);
}

TEST(StretchConstraint, EdgeByEdgeAndSideBySideGiveTheSameBits) {
  std::vector<Vec3> places, expected;
  for (const VectorSet set : kVectorSets) {
    if (set > widest_vectors()) continue;
    static constexpr std::uint32_t kPins[] = {0, 6};
    Sheet sheet(make_grid({.rows = 9, .columns = 7}), kPins);
    shake(sheet.previous, sheet.count, 0.02f, 6);
    shake(sheet.position, sheet.count, 0.03f, 7);
    const Garment& g = sheet.garment;
    sheet.position.set(g.edge_particle[0][0], sheet.position[g.edge_particle[1][0]]);  // an edge without length
    Stats stats;
    for (int pass = 0; pass < 4; ++pass) sheet.run_packed(job(sheet), stats, set);
    EXPECT_GT(stats.edges_skipped, 0u);
    places.clear();
    for (std::uint32_t i = 0; i < sheet.count; ++i) places.push_back(sheet.position[i]);
    if (set == VectorSet::kBaseline) expected = places;
    EXPECT_EQ(std::memcmp(places.data(), expected.data(), 63 * sizeof(Vec3)), 0);
  }
}

TEST(StretchConstraint, CollapsedEdgesAreSkippedAndCounted) {
  Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -1}}, {{0, 1, 2}}});
  for (std::uint32_t i = 0; i < 3; ++i) sheet.position.set(i, {1, 1, 1});
  Stats stats;
  sheet.run_packed(job(sheet), stats);
  EXPECT_EQ(stats.edges_skipped, 3u);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(sheet.position[i], (Vec3{1, 1, 1}));
}

}  // namespace
}  // namespace pleat
