#include "systems/inner_friction.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr std::uint32_t kPin[] = {3};

/// Nothing is held yet.
Vec3View held_column(std::uint32_t count) {
  static Vec3Column column(std::pmr::new_delete_resource());
  column.resize(0);
  column.resize(count);
  return column.view();
}

InnerFriction job(Sheet& sheet, float deceleration, float dt = 1e-3f) {
  return {.garment = &sheet.garment,
          .mass = sheet.mass,
          .velocity = sheet.velocity,
          .deceleration = deceleration,
          .dt = dt,
          .elapsed = dt,
          .held = held_column(sheet.count),
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
  bad = good, bad.held = {};
  EXPECT_FALSE(bad.validate());
  for (const float value : {-1.0f, kNan}) {
    bad = good, bad.deceleration = value;
    EXPECT_FALSE(bad.validate());
  }
  bad = good, bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
  for (const float value : {0.0f, 2.0f * good.dt}) {
    bad = good, bad.elapsed = value;
    EXPECT_FALSE(bad.validate());
  }
}

TEST(InnerFriction, SlowsFastAndSlowMotionAlike) {
  for (const float speed : {1.0f, 10.0f, 100.0f}) {
    Sheet sheet(make_grid({.rows = 2, .columns = 2}), kPin);
    const Vec3 along{0.6f, 0.0f, -0.8f};
    sheet.velocity.set(0, along * speed);
    job(sheet, 0.05f).run();
    EXPECT_LT(length(sheet.force[0] * sheet.inverse_mass[0] + along * 0.05f), 1e-6f) << speed;
  }
}

/// One particle with inner friction a, under any other acceleration.
class Particle {
 public:
  Particle(float a, float dt) : friction_(job(sheet_, a, dt)) {}
  void step(const Vec3& acceleration) {
    sheet_.clear_force();
    friction_.run();
    sheet_.velocity.add(0, (sheet_.force[0] * sheet_.inverse_mass[0] + acceleration) * friction_.dt);
    sheet_.position.add(0, sheet_.velocity[0] * friction_.dt);
  }
  void start(const Vec3& x, const Vec3& v) { sheet_.position.set(0, x), sheet_.velocity.set(0, v); }
  Vec3 x() const { return sheet_.position[0]; }
  Vec3 v() const { return sheet_.velocity[0]; }

 private:
  Sheet sheet_{make_grid({.rows = 2, .columns = 2}), kPin};
  InnerFriction friction_;
};

/// x'' = -w^2 x with friction a comes to rest after as many swings as 4 a / w^2 goes into the amplitude.
TEST(InnerFriction, SwingLosesTheSameLengthEachPeriod) {
  const float w = 6.0f, a = 0.05f, dt = 1e-4f, start = 0.02f;
  Particle particle(a, dt);
  particle.start({start, 0, 0}, {});
  const int period = static_cast<int>(2.0f * 3.14159265f / (w * dt));
  for (int step = 0; step < 2 * period; ++step) particle.step(particle.x() * (-w * w));
  EXPECT_NEAR(particle.x().x, start - 2.0f * 4.0f * a / (w * w), 3e-4f);
}

/// What has stopped does not creep: a push of less than 2 a moves it by push / w^2, w = 1 / (4 dt), once and for all.
/// Beyond 2 a it breaks loose, and a is what goes on holding it.
TEST(InnerFriction, HoldsWhatHasStopped) {
  const float a = 0.05f, dt = 1.0f / 480;
  for (const float push : {0.5f * a, 1.5f * a}) {
    Particle particle(a, dt);
    particle.start({}, {});
    for (int step = 0; step < 48000; ++step) particle.step({push, 0, 0});
    EXPECT_NEAR(particle.x().x, push * 16.0f * dt * dt, 1e-7f) << push;
  }
  Particle loose(a, dt);
  loose.start({}, {});
  for (int step = 0; step < 960; ++step) loose.step({3.0f * a, 0, 0});
  EXPECT_NEAR(loose.v().x, 2.0f * a * 2.0f, 0.1f * a);
}

/// Beside a saddle that drives it apart with x'' = w^2 x, a particle that is let go within 2 a / w^2 stays.
TEST(InnerFriction, HoldsAFoldThatIsAboutToSlip) {
  const float w = 5.0f, a = 0.05f;
  for (const float share : {0.9f, 1.1f}) {
    Particle particle(a, 1.0f / 480);
    const float start = share * 2.0f * a / (w * w);
    particle.start({start, 0, 0}, {});
    for (int step = 0; step < 4800; ++step) particle.step(particle.x() * (w * w));
    if (share < 1.0f) {
      EXPECT_NEAR(particle.x().x, start, 1e-5f);
    } else {
      EXPECT_GT(particle.x().x, 10.0f * start);
    }
  }
}

TEST(InnerFriction, NeverReversesMotionAtAnyStrength) {
  for (const float speed : {1e-5f, 1.0f}) {
    Particle particle(1e6f, 1.0f / 60);
    particle.start({}, {speed, 0, 0});
    for (int step = 0; step < 3; ++step) {
      const float before = particle.v().x;
      particle.step({});
      EXPECT_LE(particle.v().x, before);
      EXPECT_GE(particle.v().x, -0.1f * speed);
    }
  }
}

/// A step of four stages counts as one.
TEST(InnerFriction, StagesShareTheTimeOfTheirStep) {
  Sheet sheet(make_grid({.rows = 2, .columns = 2}), kPin);
  sheet.velocity.set(0, {1e-6f, 0, 0});
  InnerFriction friction = job(sheet, 0.05f);
  friction.run();
  const float once = friction.held[0].x;
  friction.held.set(0, {});
  friction.elapsed = 0.25f * friction.dt;
  for (int stage = 0; stage < 4; ++stage) friction.run();
  EXPECT_NEAR(friction.held[0].x, once, 1e-6f * once);
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

TEST(InnerFriction, PropertyEveryVectorSetGivesTheSameBits) {
  for (std::uint32_t n = 2; n < 8; ++n) {
    std::vector<Vec3> found, expected;
    for (const VectorSet set : kVectorSets) {
      if (set > widest_vectors()) continue;
      found.clear();
      Sheet sheet(make_grid({.rows = n, .columns = n}));
      shake(sheet.velocity, sheet.count, 0.01f, n);
      const InnerFriction friction = job(sheet, 0.1f);
      for (int step = 0; step < 5; ++step) friction.run(set);
      for (std::uint32_t i = 0; i < sheet.count; ++i) {
        found.push_back(sheet.force[i]);
        found.push_back(friction.held[i]);
      }
      if (set == VectorSet::kBaseline) expected = found;
      EXPECT_EQ(found, expected) << n;
    }
  }
}

}  // namespace
}  // namespace pleat
