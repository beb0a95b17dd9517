#include "systems/rounding_hold.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr float kDt = 1.0f / 480, kW2 = 120.0f * 120.0f;

struct State {
  Vec3Column previous{std::pmr::new_delete_resource()}, position{std::pmr::new_delete_resource()};
  Vec3Column velocity{std::pmr::new_delete_resource()}, held{std::pmr::new_delete_resource()};
  std::size_t count;

  explicit State(std::size_t n) : count(n) {
    for (Vec3Column* column : {&previous, &position, &velocity, &held}) column->resize(n);
  }
  RoundingHold job() {
    return {.particle_count = count,
            .previous = previous.view(),
            .position = position.view(),
            .velocity = velocity.view(),
            .dt = kDt,
            .friction_dt = kDt,
            .held = held.view()};
  }
};

TEST(RoundingHold, RefusesToRunWithAFieldMissing) {
  State s(1);
  ASSERT_TRUE(s.job().validate());
  RoundingHold bad = s.job();
  bad.previous = {};
  EXPECT_FALSE(bad.validate());
  bad = s.job(), bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = s.job(), bad.velocity = {};
  EXPECT_FALSE(bad.validate());
  bad = s.job(), bad.held = {};
  EXPECT_FALSE(bad.validate());
  bad = s.job(), bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
  bad = s.job(), bad.friction_dt = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST(RoundingHold, RemembersTheWayThatAPositionCouldNotGo) {
  State s(1);
  const Vec3 x{1.0f, -2.0f, 0.0f}, v{1e-5f, 0.0f, 0.0f};
  ASSERT_EQ(x + v * kDt, x);
  s.previous.view().set(0, x), s.position.view().set(0, x), s.velocity.view().set(0, v);
  s.job().run();
  s.job().run();
  EXPECT_NEAR(s.held.view()[0].x, -2.0f * v.x * kDt * kW2, 1e-9f);
  EXPECT_EQ(s.held.view()[0].y, 0.0f);
  EXPECT_EQ(s.held.view()[0].z, 0.0f);

  State split(1);  // a substep with four steps of forces, whose spring is as much stiffer
  split.previous.view().set(0, x), split.position.view().set(0, x), split.velocity.view().set(0, v);
  RoundingHold job = split.job();
  job.friction_dt = kDt / 4;
  job.run();
  EXPECT_NEAR(split.held.view()[0].x, -v.x * kDt * 16 * kW2, 1e-9f);
}

TEST(RoundingHoldProperty, TheSpringKnowsTheWayOfAParticleThatWanders) {
  // s is w^2 times the way: what InnerFriction adds up of the velocity, and what this adds of the rest.
  State s(1);
  std::mt19937 random(4);
  const Vec3 start{0.7f, 1.3f, -3.1f};
  s.position.view().set(0, start);
  Vec3T<double> by_velocity;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 v = Vec3{1, 1, 1} * (2e-5f * (static_cast<float>(random() >> 8) / 8388608.0f - 1.0f));
    s.velocity.view().set(0, v);
    s.previous.view().set(0, s.position.view()[0]);
    s.position.view().add(0, v * kDt);
    s.job().run();
    by_velocity += wide(v) * double(kDt);
  }
  const Vec3T<double> way = wide(s.position.view()[0] - start), known = wide(s.held.view()[0]) * (1.0 / double(kW2));
  EXPECT_GT(length(way - by_velocity), 1e-7);
  EXPECT_LT(length(way - by_velocity - known), 0.02 * length(way - by_velocity));
}

TEST(RoundingHold, WhatIsMoreThanRoundingStaysOut) {
  State s(4);
  s.position.view().set(0, {1.0f + 1e-5f, 0.0f, 0.0f}), s.previous.view().set(0, {1.0f, 0.0f, 0.0f});  // a push
  s.position.view().set(1, {kNan, 0.0f, 0.0f});
  s.position.view().set(2, {1.0f, 0.0f, 0.0f}), s.previous.view().set(2, {1.0f, 0.0f, 0.0f});
  s.velocity.view().set(2, {kInfinity, 0.0f, 0.0f});
  s.velocity.view().set(3, {1.0f, 0.0f, 0.0f});  // moves, and is rounded
  s.position.view().set(3, {1.0f + 1.0f / 480, 0.0f, 0.0f}), s.previous.view().set(3, {1.0f, 0.0f, 0.0f});
  s.job().run();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(s.held.view()[i], Vec3{});
}

}  // namespace
}  // namespace pleat
