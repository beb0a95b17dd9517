#include "systems/edge_damping.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

EdgeDamping job(Sheet& sheet, float rate, float dt = 1.0f / 60) {
  return {.garment = &sheet.garment,
          .position = sheet.position,
          .velocity = sheet.velocity,
          .inverse_mass = sheet.inverse_mass,
          .rate = rate,
          .dt = dt,
          .packed = &sheet.packed,
          .force = sheet.force};
}

Sheet moving_sheet() {
  Sheet sheet(make_grid({.rows = 6, .columns = 6}));
  shake(sheet.position, sheet.count, 0.05f, 1);
  shake(sheet.velocity, sheet.count, 3.0f, 2);
  return sheet;
}

double kinetic_energy(const Sheet& sheet) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    sum += 0.5 * static_cast<double>(sheet.mass[i]) * dot(wide(sheet.velocity[i]), wide(sheet.velocity[i]));
  }
  return sum;
}

TEST(EdgeDamping, RefusesToRunWithAFieldMissing) {
  Sheet sheet = moving_sheet();
  const EdgeDamping good = job(sheet, 4.0f);
  ASSERT_TRUE(good.validate());
  EdgeDamping bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.rate = kNan;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(EdgeDamping, KeepsMomentum) {
  Sheet sheet = moving_sheet();
  job(sheet, 4.0f).run();
  const Totals sum = totals(sheet.position, sheet.force, sheet.count);
  EXPECT_GT(sum.size, 1e-3);
  EXPECT_LT(length(sum.force), 1e-6 * sum.size);
  EXPECT_LT(length(sum.torque), 1e-6 * sum.size);
}

TEST(EdgeDamping, LeavesRigidMotionAlone) {
  Sheet sheet(make_grid({.rows = 4, .columns = 4}));
  const Vec3 turn{1.0f, -2.0f, 0.5f};
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    sheet.velocity.set(i, Vec3{3, 4, 5} + cross(turn, sheet.position[i]));
  }
  job(sheet, 4.0f).run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_LT(length(sheet.force[i]), 1e-6f);
}

TEST(EdgeDamping, TakesItsRateOfAnEdgesMotionAndNeverReversesIt) {
  const float dt = 1.0f / 60;
  for (const float rate : {0.0f, 4.0f, 12.0f, 1e6f}) {
    Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -1}}, {{0, 1, 2}}});
    sheet.inverse_mass[2] = 0.0f;
    // Along 0-1 apart, with what the other edges see cancelled by taking corner 2 along the bisectors out of play.
    sheet.velocity.set(0, {-1, 0, -0.5f});
    sheet.velocity.set(1, {1, 0, -0.5f});
    job(sheet, rate, dt).run();
    const float before = 2.0f;
    for (std::uint32_t i = 0; i < 2; ++i) sheet.velocity.add(i, sheet.force[i] * (dt * sheet.inverse_mass[i]));
    const float after = sheet.velocity[1].x - sheet.velocity[0].x;
    EXPECT_NEAR(after / before, 1.0f - std::min(rate * dt, 0.2f), 1e-5f) << rate;
  }
}

TEST(EdgeDamping, NeverAddsEnergyAtAnyRate) {
  Sheet sheet = moving_sheet();
  double energy = kinetic_energy(sheet);
  for (int step = 0; step < 50; ++step) {
    sheet.clear_force();
    job(sheet, 1e6f).run();
    for (std::uint32_t i = 0; i < sheet.count; ++i)
      sheet.velocity.add(i, sheet.force[i] * sheet.inverse_mass[i] * (1.0f / 60));
    const double now = kinetic_energy(sheet);
    EXPECT_LE(now, energy * (1.0 + 1e-6));
    energy = now;
  }
}

TEST(EdgeDamping, CollapsedAndPinnedEdgesArePassedOver) {
  const std::uint32_t pins[] = {0, 1};
  Sheet sheet({{{0, 0, 0}, {1, 0, 0}, {0.5f, 0, -1}}, {{0, 1, 2}}}, pins);
  sheet.position.set(2, sheet.position[0]);
  sheet.velocity.set(0, {0, 5, 0});
  job(sheet, 4.0f).run();
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_TRUE(is_finite(sheet.force[i]));
  EXPECT_EQ(sheet.force[0], Vec3{});
}

}  // namespace
}  // namespace pleat
