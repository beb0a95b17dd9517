#include "systems/air_drag.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kDensity = 0.2f, kDrag = 1.28f, kAir = 1.225f;

AirDrag job(Sheet& sheet, const Vec3& wind = {}, float dt = 1.0f / 480) {
  return {.garment = &sheet.garment,
          .position = sheet.position,
          .velocity = sheet.velocity,
          .wind = wind,
          .air_density = kAir,
          .drag_coefficient = kDrag,
          .density = kDensity,
          .dt = dt,
          .force = sheet.force};
}

void step(Sheet& sheet, float dt) {
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    sheet.velocity.add(i, sheet.force[i] * (dt * sheet.inverse_mass[i]));
    sheet.position.add(i, sheet.velocity[i] * dt);
  }
}

TEST(AirDrag, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  const AirDrag good = job(sheet);
  ASSERT_TRUE(good.validate());
  AirDrag bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.wind.x = kNan;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.air_density = -1.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.drag_coefficient = kNan;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.lift_coefficient = -1.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.density = 0.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(AirDrag, FallingSheetReachesItsTerminalVelocity) {
  Sheet sheet(make_grid({.rows = 4, .columns = 4}), {}, kDensity);
  const float dt = 1.0f / 480, terminal = std::sqrt(2.0f * kDensity * 9.81f / (kAir * kDrag));
  ASSERT_NEAR(terminal, 1.582f, 1e-3f);
  for (int i = 1; i <= 960; ++i) {
    sheet.clear_force();
    job(sheet, {}, dt).run();
    for (std::uint32_t p = 0; p < sheet.count; ++p) sheet.force.add(p, Vec3{0, -9.81f, 0} * sheet.mass[p]);
    step(sheet, dt);
    const float t = static_cast<float>(i) * dt;
    if (i % 96 == 0) {
      EXPECT_NEAR(-sheet.velocity[5].y, terminal * std::tanh(9.81f * t / terminal), 0.01f * terminal) << t;
    }
  }
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_NEAR(-sheet.velocity[i].y / terminal, 1.0f, 0.005f);
}

TEST(AirDrag, ActsOnTheNormalPartAndTheWrongSideAlike) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}), {}, kDensity);
  job(sheet, {7, 0, 0}).run();  // along the sheet
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_EQ(length(sheet.force[i]), 0.0f);
  for (const float wind : {2.0f, -2.0f}) {
    sheet.clear_force();
    job(sheet, {3, wind, 0}).run();
    Vec3 sum;
    for (std::uint32_t i = 0; i < sheet.count; ++i) sum += sheet.force[i];
    EXPECT_NEAR(sum.y, 0.5f * kAir * kDrag * wind * std::abs(wind), 1e-5f);  // of 1 m2
    EXPECT_NEAR(sum.x, 0.0f, 1e-6f);
  }
}

TEST(AirDrag, LiftIsAcrossTheWindAndWantsASlant) {
  const auto total = [](const Vec3& wind) {
    Sheet sheet(make_grid({.rows = 2, .columns = 2}), {}, kDensity);
    AirDrag lifting = job(sheet, wind);
    lifting.drag_coefficient = 0.0f;
    lifting.lift_coefficient = 1.0f;
    lifting.run();
    Vec3 sum;
    for (std::uint32_t i = 0; i < sheet.count; ++i) sum += sheet.force[i];
    return sum;
  };
  EXPECT_NEAR(length(total({0, 5, 0})), 0.0f, 1e-6f);  // face on
  EXPECT_NEAR(length(total({5, 0, 0})), 0.0f, 1e-6f);  // edge on
  const float slant = 0.1f, speed = 5.0f;
  const Vec3 sum = total({speed * std::cos(slant), speed * std::sin(slant), 0});
  EXPECT_NEAR(sum.y, 0.5f * kAir * speed * speed * std::sin(slant) * (1.0f - std::sin(slant)), 1e-4f);
  EXPECT_EQ(sum.x, 0.0f);  // air presses, it does not rub
}

TEST(AirDrag, NoStepTurnsTheMotionAroundWhateverTheWind) {
  Sheet sheet(make_grid({.rows = 4, .columns = 4}), {}, kDensity);
  const float dt = 1.0f / 60;
  job(sheet, {0, 1000, 0}, dt).run();
  step(sheet, dt);
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    EXPECT_GT(sheet.velocity[i].y, 0.0f);
    EXPECT_LE(sheet.velocity[i].y, 1000.1f);
  }
}

TEST(AirDrag, StormDoesNotBlowUp) {
  Sheet sheet(make_grid({.rows = 4, .columns = 4}), {}, kDensity);
  shake(sheet.position, sheet.count, 0.05f, 1);
  for (int i = 0; i < 2000; ++i) {
    sheet.clear_force();
    job(sheet, {600, 800, 0}).run();
    step(sheet, 1.0f / 480);
  }
  for (std::uint32_t i = 0; i < sheet.count; ++i) {
    EXPECT_TRUE(is_finite(sheet.position[i]));
    EXPECT_LT(length(sheet.velocity[i]), 2000.0f);
  }
}

TEST(AirDrag, FaceWithoutAreaIsPassedOver) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}));
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, {1, 1, 1});
  job(sheet, {0, 1000, 0}).run();
  for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_EQ(sheet.force[i], Vec3{});
}

}  // namespace
}  // namespace pleat
