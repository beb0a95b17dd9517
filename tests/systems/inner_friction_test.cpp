#include "systems/inner_friction.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr std::uint32_t kPin[] = {3};

InnerFriction job(Sheet& sheet, float deceleration, float dt = 1e-3f) {
  return {.garment = &sheet.garment,
          .mass = sheet.mass,
          .velocity = sheet.velocity,
          .deceleration = deceleration,
          .dt = dt,
          .force = sheet.force};
}

TEST(InnerFriction, RefusesToRunWithAFieldMissing) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}), kPin);
  const InnerFriction good = job(sheet, 0.1f);
  ASSERT_TRUE(good.validate());
  InnerFriction bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.force = {};
  EXPECT_FALSE(bad.validate());
  for (const float value : {-1.0f, kNan}) {
    bad = good, bad.deceleration = value;
    EXPECT_FALSE(bad.validate());
  }
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(InnerFriction, SlowsFastAndSlowMotionAlike) {
  for (const float speed : {0.01f, 1.0f, 100.0f}) {
    Sheet sheet(make_grid({.rows = 2, .columns = 2}), kPin);
    const Vec3 along{0.6f, 0.0f, -0.8f};
    sheet.velocity.set(0, along * speed);
    job(sheet, 0.05f).run();
    EXPECT_LT(length(sheet.force[0] * sheet.inverse_mass[0] + along * 0.05f), 1e-6f) << speed;
  }
}

/// x'' = -w^2 x with friction a comes to rest after as many swings as 4 a / w^2 goes into the amplitude.
TEST(InnerFriction, SwingLosesTheSameLengthEachPeriod) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}), kPin);
  const float w = 6.0f, a = 0.05f, dt = 1e-4f, start = 0.02f;
  sheet.position.set(0, {start, 0, 0});
  sheet.velocity.set(0, {});
  const int period = static_cast<int>(2.0f * 3.14159265f / (w * dt));
  for (int step = 0; step < 2 * period; ++step) {
    sheet.clear_force();
    job(sheet, a, dt).run();
    const Vec3 pull = sheet.position[0] * (-w * w);
    sheet.velocity.add(0, (sheet.force[0] * sheet.inverse_mass[0] + pull) * dt);
    sheet.position.add(0, sheet.velocity[0] * dt);
  }
  EXPECT_NEAR(sheet.position[0].x, start - 2.0f * 4.0f * a / (w * w), 3e-4f);
}

TEST(InnerFriction, NeverReversesMotionAtAnyStrength) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}), kPin);
  sheet.velocity.set(0, {1e-5f, 0, 0});
  job(sheet, 1e6f, 1.0f / 60).run();
  EXPECT_NEAR(1e-5f + sheet.force[0].x * sheet.inverse_mass[0] / 60, 0.5e-5f, 1e-10f);
}

/// What is worn is slowed against its wearer, what flies only against itself.
TEST(InnerFriction, ClothThatIsCarriedAlongFeelsNothing) {
  for (const bool pinned : {true, false}) {
    Sheet sheet(make_grid({.rows = 4, .columns = 4}), std::span(kPin, pinned ? 1 : 0));
    for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.velocity.set(i, {3, -4, 12});
    job(sheet, 0.05f).run();
    for (std::uint32_t i = 0; i < sheet.count; ++i) EXPECT_LT(length(sheet.force[i] * (1 / sheet.mass[i])), 1e-3f) << i;
  }
}

TEST(InnerFriction, PropertyFreeClothKeepsItsMomentum) {
  Sheet sheet(make_grid({.rows = 5, .columns = 5}));
  shake(sheet.velocity, sheet.count, 1.0f, 1);
  job(sheet, 0.05f).run();
  const Totals sum = totals(sheet.position, sheet.force, sheet.count);
  EXPECT_LT(length(sum.force), 1e-6 * sum.size);
}

}  // namespace
}  // namespace pleat
