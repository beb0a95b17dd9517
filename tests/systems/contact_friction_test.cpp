#include "systems/contact_friction.h"

#include <gtest/gtest.h>

#include "systems/collision_response.h"
#include "systems/contact_acceleration.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kDt = 0.002f, kThickness = 0.005f, kGravity = 9.81f;

ContactFriction friction_of(ContactCloth& c) { return {.contacts = c.contacts(), .previous = c.packed_previous()}; }

/// A particle on a plane through the origin that is tilted about z.
struct Incline {
  ContactCloth cloth{{{0, 0, 0}, {0, 100, 0}, {1, 100, 0}}, {{0, 1, 2}}};
  Vec3 normal, downhill;
  float friction;
  Vec3 plane_velocity;
  Vec3 plane;
  bool constrain_acceleration;
  Stats stats;

  Incline(float degrees, float mu, bool acceleration)
      : normal{std::sin(degrees * 0.0174532925f), std::cos(degrees * 0.0174532925f), 0},
        downhill{normal.y, -normal.x, 0},
        friction(mu),
        constrain_acceleration(acceleration) {
    cloth.put(0, normal * kThickness, {});
  }

  void substep() {
    ContactCloth& c = cloth;
    c.force.view().set(0, Vec3{0, -kGravity, 0} * (1.0f / c.inverse_mass[0]));
    if (constrain_acceleration) {
      ContactAcceleration{c.contacts(), c.position.view(), c.velocity.view(), c.inverse_mass.data(), kDt,
                          kDt,          c.force.view()}
          .run();
    }
    c.velocity.view().add(0, c.force.view()[0] * (c.inverse_mass[0] * kDt));
    const Vec3 before = c.x(0), predicted = before + c.velocity.view()[0] * kDt;
    c.put(0, predicted, before);
    plane += plane_velocity * kDt;
    c.row_count = 0;
    add_row();
    const CollisionResponse response{.contacts = c.contacts()};
    for (int i = 0; i < 3; ++i) c.run(response, stats);
    c.run(friction_of(c));
    c.run(response, stats);
    c.velocity.view().add(0, (c.x(0) - predicted) * (1.0f / kDt));
    ContactVelocity{c.contacts(), kDt, c.velocity.view()}.run();
  }

  void add_row() {
    cloth.contacts().add({.particle = {0, 0, 0},
                          .weight = {1, 0, 0},
                          .normal = normal,
                          .offset = dot(normal, plane) + kThickness,
                          .body_step = plane_velocity * kDt,
                          .friction = friction,
                          .share = {1},
                          .count = 1,
                          .push = 0.0f,
                          .rubbed = 0.0f});
  }
};

TEST(ContactFriction, SticksBelowTheFrictionAngleAndSlidesAbove) {
  for (const bool acceleration : {false, true}) {
    for (const float degrees : {5.0f, 10.0f, 16.0f, 20.0f, 30.0f, 45.0f}) {
      Incline incline(degrees, 0.3f, acceleration);
      for (int n = 0; n < 500; ++n) incline.substep();
      const float angle = degrees * 0.0174532925f, speed = dot(incline.cloth.velocity.view()[0], incline.downhill);
      const float pull = kGravity * (std::sin(angle) - 0.3f * std::cos(angle));
      if (pull < 0.0f) {
        EXPECT_NEAR(speed, 0.0f, 1e-5f) << degrees;
        EXPECT_NEAR(dot(incline.cloth.x(0), incline.downhill), 0.0f, 1e-5f) << degrees;
      } else {
        EXPECT_NEAR(speed, pull * 500.0f * kDt, 0.01f * pull) << degrees << (acceleration ? " constrained" : "");
      }
      EXPECT_NEAR(dot(incline.cloth.x(0), incline.normal), kThickness, 1e-5f);
    }
  }
}

TEST(ContactFriction, MovingSurfaceCarriesWhatLiesOnIt) {
  for (const bool acceleration : {false, true}) {
    Incline incline(0.0f, 0.5f, acceleration);
    incline.plane_velocity = {1, 0, 0};
    const float needed = 1.0f / (0.5f * kGravity);  // s until the particle has the belt's speed
    const int substeps = static_cast<int>(needed / kDt);
    for (int n = 0; n < substeps / 2; ++n) incline.substep();
    EXPECT_NEAR(incline.cloth.velocity.view()[0].x, 0.5f, 0.02f);
    for (int n = 0; n < substeps; ++n) incline.substep();
    EXPECT_NEAR(incline.cloth.velocity.view()[0].x, 1.0f, 1e-4f);
  }
}

TEST(ContactFriction, DoesNotPullWithoutPush) {
  Incline incline(0.0f, 1.0f, false);
  incline.add_row();
  incline.cloth.put(0, {1, 1, 0}, {0, 1, 0});
  incline.cloth.run(friction_of(incline.cloth));
  EXPECT_EQ(incline.cloth.x(0), (Vec3{1, 1, 0}));
}

TEST(ContactFriction, TakesBackNoMoreInTwoRunsThanInOne) {
  Incline incline(0.0f, 0.5f, false);
  ContactCloth& c = incline.cloth;
  incline.add_row();
  c.rows[0].push = 0.001f;
  c.put(0, {1.0f, 0, 0}, {0, 0, 0});
  c.run(friction_of(c));
  EXPECT_NEAR(c.x(0).x, 1.0f - 0.0005f, 1e-6f);
  c.run(friction_of(c));
  EXPECT_NEAR(c.x(0).x, 1.0f - 0.0005f, 1e-6f);
}

TEST(ContactFriction, LeavesASlipThatIsLongerThanAsked) {
  Incline incline(0.0f, 0.5f, false);
  ContactCloth& c = incline.cloth;
  ContactFriction stick = friction_of(c);
  stick.longest = 1e-4f;
  for (const float slip : {0.9e-4f, 1.1e-4f}) {
    c.row_count = 0;
    incline.add_row();
    c.rows[0].push = 0.001f;
    c.put(0, {slip, 0, 0}, {0, 0, 0});
    c.run(stick);
    EXPECT_NEAR(c.x(0).x, slip < stick.longest ? 0.0f : slip, 1e-9f);
  }
}

TEST(ContactVelocity, TakesOutOnlyLeavingVelocityOfRowsThatPushed) {
  Incline incline(0.0f, 0.0f, false);
  ContactCloth& c = incline.cloth;
  const auto run = [&](const Vec3& v, float push) {
    c.row_count = 0;
    incline.add_row();
    c.rows[0].push = push;
    c.velocity.view().set(0, v);
    ContactVelocity{c.contacts(), kDt, c.velocity.view()}.run();
    return c.velocity.view()[0];
  };
  EXPECT_EQ(run({1, 2, 3}, 0.001f), (Vec3{1, 0, 3}));
  EXPECT_EQ(run({1, 2, 3}, 0.0f), (Vec3{1, 2, 3}));
  EXPECT_EQ(run({1, -2, 3}, 0.001f), (Vec3{1, -2, 3}));
}

TEST(ContactAcceleration, TakesOutTheForceIntoTheBodyOnly) {
  Incline incline(0.0f, 0.0f, true);
  ContactCloth& c = incline.cloth;
  const auto run = [&](const Vec3& force, const Vec3& velocity, float height) {
    c.row_count = 0;
    incline.add_row();
    c.put(0, {0, kThickness + height, 0}, {});
    c.velocity.view().set(0, velocity);
    c.force.view().set(0, force);
    const ContactAcceleration system{c.contacts(), c.position.view(), c.velocity.view(), c.inverse_mass.data(), kDt,
                                     kDt,          c.force.view()};
    EXPECT_TRUE(system.validate());
    system.run();
    return c.force.view()[0];
  };
  EXPECT_EQ(run({1, -2, 3}, {}, 0.0f), (Vec3{1, 0, 3}));
  EXPECT_EQ(run({1, 2, 3}, {}, 0.0f), (Vec3{1, 2, 3})) << "pulled away";
  EXPECT_EQ(run({1, -2, 3}, {}, 0.001f), (Vec3{1, -2, 3})) << "not touching";
  EXPECT_EQ(run({1, -2, 3}, {0, 1, 0}, 0.0f), (Vec3{1, -2, 3})) << "leaving";
}

TEST(ContactAcceleration, ABodyIsAsFastWhereForcesActInShorterSteps) {
  Incline belt(0.0f, 0.5f, true);
  belt.plane_velocity = {2.0f, 0.0f, 0.0f};
  ContactCloth& c = belt.cloth;
  belt.add_row();
  c.put(0, {0, kThickness, 0}, {});
  const auto drag_at = [&](const Vec3& velocity) {
    c.velocity.view().set(0, velocity);
    c.force.view().set(0, {0, -1, 0});
    const ContactAcceleration system{.contacts = c.contacts(),
                                     .position = c.position.view(),
                                     .velocity = c.velocity.view(),
                                     .inverse_mass = c.inverse_mass.data(),
                                     .dt = kDt / 4,
                                     .row_dt = kDt,
                                     .force = c.force.view()};
    system.run();
    return c.force.view()[0];
  };
  EXPECT_EQ(drag_at({2.0f, 0, 0}), (Vec3{})) << "carried along";
  EXPECT_NEAR(drag_at({0, 0, 0}).x, 0.5f, 1e-6f);
  EXPECT_NEAR(drag_at({3.0f, 0, 0}).x, -0.5f, 1e-6f);
}

}  // namespace
}  // namespace pleat::test
