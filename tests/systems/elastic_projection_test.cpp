#include "systems/elastic_projection.h"

#include <gtest/gtest.h>

#include <vector>

#include "components/lanes.h"
#include "systems/edge_damping.h"
#include "systems/elastic_force.h"
#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kDt = 1.0f / 480;

ElasticProjection job(Sheet& s, float stiffness) {
  return {.garment = &s.garment, .law = {stiffness}, .dt = kDt, .way = s.ways(), .position = &s.packed.position};
}
Sheet shaken_sheet() {
  static constexpr std::uint32_t kPins[] = {0, 4};
  Sheet sheet(make_grid({.rows = 5, .columns = 5}), kPins);
  shake(sheet.position, sheet.count, 0.1f, 5);
  return sheet;
}

TEST(ElasticProjection, RefusesToRunWithAFieldMissing) {
  Sheet sheet = shaken_sheet();
  const ElasticProjection good = job(sheet, 30.0f);
  ASSERT_TRUE(good.validate());
  ElasticProjection bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.way = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = nullptr;
  EXPECT_FALSE(bad.validate());
  for (const float value : {0.0f, -1.0f, kNan}) {
    bad = good, bad.law.stiffness = value;
    EXPECT_FALSE(bad.validate());
    bad = good, bad.dt = value;
    EXPECT_FALSE(bad.validate());
  }
  for (const float value : {-1.0f, kNan}) {
    bad = good, bad.damping_rate = value;
    EXPECT_FALSE(bad.validate());
  }
}

TEST(ElasticProjection, OfSoftEdgesIsTheirForce) {
  Sheet projected = shaken_sheet(), forced = shaken_sheet();
  constexpr float kSoft = 0.1f;
  projected.run_packed(job(projected, kSoft));
  ElasticForce{&forced.garment, forced.position, forced.inverse_mass, {kSoft}, 1e30f, forced.force}.run();
  for (std::uint32_t i = 0; i < forced.count; ++i) {
    const Vec3 expected = forced.force[i] * (forced.inverse_mass[i] * kDt * kDt);
    EXPECT_NEAR(length(projected.position[i] - forced.position[i] - expected), 0.0f, 0.02f * length(expected) + 1e-7f);
  }
}

TEST(ElasticProjection, OfAStiffEdgeIsItsRestLength) {
  for (const float stretch : {0.2f, 0.9f, 1.5f, 20.0f}) {
    Sheet face({{{0, 0, 0}, {2, 0, 0}, {1, 0, -1}}, {{0, 1, 2}}});
    for (std::uint32_t i = 0; i < 3; ++i) face.position.set(i, face.position[i] * stretch);
    face.run_packed(job(face, 1e12f));
    const std::uint32_t last = face.garment.edge_count - 1;  // nothing moves its ends afterwards
    const Vec3 d =
        face.position[face.garment.edge_particle[1][last]] - face.position[face.garment.edge_particle[0][last]];
    EXPECT_NEAR(length(d), face.garment.edge_rest_length[last], 1e-4f) << stretch;
  }
}

TEST(ElasticProjection, EndsWhereTheForceOfItsLawLeadsThere) {
  for (const float stretch : {0.3f, 0.9f, 0.97f, 0.985f, 0.995f, 1.2f}) {
    for (const float stiffness : {1.0f, 1e3f, 1e5f}) {
      Sheet face({{{0, 0, 0}, {2, 0, 0}, {1, 0, -1}}, {{0, 1, 2}}});
      const std::uint32_t i = face.garment.edge_particle[0][0], j = face.garment.edge_particle[1][0];
      const float rest = face.garment.edge_rest_length[0];
      for (std::uint32_t k = 0; k < 3; ++k) face.position.set(k, face.position[k] * stretch);
      face.garment.slots.count = kLanes;  // its first edge
      ElasticProjection edge = job(face, stiffness);
      edge.law.buckling = 0.01f;
      const Vec3 before = face.position[j] - face.position[i];
      face.run_packed(edge);
      const Vec3 after = face.position[j] - face.position[i];
      // Backward Euler of the edge alone, the factor l of eq (1) taken where the step begins.
      const float s = length(after) / rest;
      const EdgeLine line = edge.law.at(s);
      const float weight = face.inverse_mass[i] + face.inverse_mass[j];
      const float pulled = weight * kDt * kDt * line.stiffness * (s - line.rest) * length(before);
      EXPECT_NEAR(length(before) - length(after), pulled, 1e-5f) << stretch << ' ' << stiffness;
    }
  }
}

/// Lets the sheet drift for a step.
void drift(Sheet& sheet, float speed) {
  shake(sheet.velocity, sheet.count, speed, 7);
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    sheet.previous.set(i, sheet.position[i]);
    if (sheet.inverse_mass[i] == 0.0f) sheet.velocity.set(i, {});
    sheet.position.add(i, sheet.velocity[i] * kDt);
  }
}

TEST(ElasticProjection, BrakesAsDampingForcesDo) {
  Sheet projected = shaken_sheet(), forced = shaken_sheet();
  drift(projected, 0.1f), drift(forced, 0.1f);
  constexpr float kRate = 0.5f;
  ElasticProjection braked = job(projected, 1e-9f);
  braked.damping_rate = kRate;
  projected.run_packed(braked);
  EdgeDamping{&forced.garment, forced.previous, forced.velocity, forced.inverse_mass, kRate, kDt,
              &forced.packed,  forced.force}
      .run();
  for (std::uint32_t i = 0; i < forced.count; ++i) {
    const Vec3 expected = forced.force[i] * (forced.inverse_mass[i] * kDt * kDt);
    EXPECT_NEAR(length(projected.position[i] - forced.position[i] - expected), 0.0f, 0.02f * length(expected) + 1e-7f);
  }
}

TEST(ElasticProjection, OfAStronglyDampedEdgeKeepsItsLength) {
  for (const float stretch : {0.9f, 1.2f}) {
    Sheet face({{{0, 0, 0}, {2, 0, 0}, {1, 0, -1}}, {{0, 1, 2}}});
    for (std::uint32_t i = 0; i < 3; ++i) {
      face.previous.set(i, face.position[i]);
      face.position.set(i, face.position[i] * stretch);
    }
    face.garment.slots.count = kLanes;  // its first edge
    ElasticProjection edge = job(face, 1e-9f);
    edge.damping_rate = 1e6f;
    face.run_packed(edge);
    const Vec3 d = face.position[face.garment.edge_particle[1][0]] - face.position[face.garment.edge_particle[0][0]];
    EXPECT_NEAR(length(d), face.garment.edge_rest_length[0], 1e-3f) << stretch;
  }
}

TEST(ElasticProjection, EdgeByEdgeAndSideBySideGiveTheSameBits) {
  std::vector<Vec3> expected;
  for (const VectorSet set : kVectorSets) {
    if (set > widest_vectors()) continue;
    Sheet sheet = shaken_sheet();
    drift(sheet, 1.0f);
    ElasticProjection projection = job(sheet, 300.0f);
    projection.damping_rate = 4.0f;
    sheet.run_packed(projection, set);
    for (std::uint32_t i = 0; i < sheet.count; ++i) {
      if (set == VectorSet::kBaseline) expected.push_back(sheet.position[i]);
      EXPECT_EQ(sheet.position[i], expected[i]);
    }
  }
}

TEST(ElasticProjection, TwoPassesAreTwoRuns) {
  Sheet once = shaken_sheet(), twice = shaken_sheet();
  ElasticProjection passes = job(once, 300.0f);
  passes.passes = 2;
  once.run_packed(passes);
  for (int k = 0; k < 2; ++k) twice.run_packed(job(twice, 300.0f));
  for (std::uint32_t i = 0; i < once.count; ++i) EXPECT_EQ(once.position[i], twice.position[i]) << i;
}

TEST(ElasticProjection, LetsAPendulumKeepItsEnergy) {
  // A stiff edge of 1 m that turns about its pin at 4 rad/s, by hand: drift, then projection, then velocities.
  static constexpr std::uint32_t kPins[] = {0};
  Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -1}}, {{0, 1, 2}}}, kPins);
  sheet.garment.slots.count = kLanes;  // its first edge
  ASSERT_EQ(sheet.garment.edge_particle[0][0] + sheet.garment.edge_particle[1][0], 1u);
  Vec3 velocity{0, 4, 0};
  constexpr int kTurn = 754;  // steps, 2 pi / (4 rad/s)
  for (int step = 0; step < 5 * kTurn; ++step) {
    sheet.previous.set(1, sheet.position[1]);
    sheet.position.add(1, velocity * kDt);
    sheet.run_packed(job(sheet, 1e9f));
    velocity = (sheet.position[1] - sheet.previous[1]) * (1.0f / kDt);
  }
  EXPECT_NEAR(length(velocity), 4.0f, 0.004f);  // pulled along the edge as it then is: 3.66
}

TEST(ElasticProjection, HoldsPinsAndSurvivesACollapsedCloth) {
  Sheet sheet = shaken_sheet();
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, {1, 2, 3});
  sheet.run_packed(job(sheet, 1e12f));
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_EQ(sheet.position[i], (Vec3{1, 2, 3}));
  sheet = shaken_sheet();
  const Vec3 pin = sheet.position[4];
  sheet.run_packed(job(sheet, 100.0f));
  EXPECT_EQ(sheet.position[4], pin);
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, {1, 2, 3});
  ElasticProjection braked = job(sheet, 1e12f);
  braked.damping_rate = 1e6f;
  sheet.run_packed(braked);
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_TRUE(is_finite(sheet.position[i]));
}

TEST(ElasticProjectionProperty, KeepsMomentum) {
  Sheet sheet(make_grid({.rows = 5, .columns = 5}));
  shake(sheet.position, sheet.count, 0.1f, 6);
  const auto moment = [&] {
    Vec3d sum;
    for (std::uint32_t i = 0; i < sheet.count; ++i) sum += wide(sheet.position[i]) * double(sheet.mass[i]);
    return sum;
  };
  const Vec3d before = moment();
  sheet.run_packed(job(sheet, 1e4f));
  EXPECT_NEAR(length(moment() - before), 0.0, 1e-7 * 0.2);
}

}  // namespace
}  // namespace pleat
