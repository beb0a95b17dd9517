#include "systems/pin_jump.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <memory_resource>

namespace pleat {
namespace {

constexpr float kTick = 1.0f / 60;

class PinJumpTest : public testing::Test {
 protected:
  static constexpr Vec3 kRing[] = {{0.2f, 1, 0}, {0, 1, 0.2f}, {-0.2f, 1, 0}, {0, 1, -0.2f}};
  Vec3Column previous{std::pmr::new_delete_resource()}, next{std::pmr::new_delete_resource()};
  Vec3 velocity;

  PinJumpTest() {
    previous.resize(4), next.resize(4);
    for (std::size_t k = 0; k < 4; ++k) previous.view().set(k, kRing[k]), next.view().set(k, kRing[k]);
  }
  PinJump job() {
    return {.count = 4,
            .previous = previous.view(),
            .next = next.view(),
            .speed = 50.0f,
            .velocity = mean_motion(previous.view(), next.view(), 4) * (1.0f / kTick),
            .velocity_before = velocity};
  }
  /// A tick in which the pins turn about the upright axis and move on.
  std::optional<RigidMotion> tick(const Vec3& way, float degrees = 0.0f) {
    const float half = degrees * 3.14159265f / 360.0f;
    const Quaternion turn{0, std::sin(half), 0, std::cos(half)};
    const Vec3View from = previous.view(), to = next.view();
    Vec3 middle;
    for (std::size_t k = 0; k < 4; ++k) from.set(k, to[k]), middle += from[k] * 0.25f;
    for (std::size_t k = 0; k < 4; ++k) to.set(k, middle + way + rotate(turn, from[k] - middle));
    const PinJump jump = job();
    velocity = jump.velocity;
    return jump.run();
  }
};

TEST_F(PinJumpTest, RefusesToRunWithAFieldMissing) {
  ASSERT_TRUE(job().validate());
  PinJump bad = job();
  bad.count = 0;
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.previous = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.next = {};
  EXPECT_FALSE(bad.validate());
  bad = job(), bad.speed = 0.0f;
  EXPECT_FALSE(bad.validate());
}

TEST_F(PinJumpTest, AJumpIsTheMotionThatThePinsMade) {
  const std::optional<RigidMotion> jump = tick({10, 0, 3}, 80.0f);
  ASSERT_TRUE(jump.has_value());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LT(length(jump->apply(previous.view()[k]) - next.view()[k]), 1e-4f);
  }
  EXPECT_FALSE(tick({}).has_value()) << "it stands where it jumped to";
}

TEST_F(PinJumpTest, SteadyMotionIsNoJumpHoweverFast) {
  for (int i = 1; i <= 40; ++i) EXPECT_FALSE(tick({0.1f * static_cast<float>(i), 0, 0}).has_value()) << i;
  EXPECT_GT(length(velocity), 200.0f);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(tick({4, 0, 0}).has_value());
  EXPECT_TRUE(tick({-1, 0, 0}).has_value()) << "back in the middle of it";
}

TEST_F(PinJumpTest, AFlingToAndFroIsNoJump) {
  for (int i = 0; i < 60; ++i) EXPECT_FALSE(tick({i % 2 == 0 ? 0.4f : -0.4f, 0, 0}).has_value());  // 24 m/s
}

TEST_F(PinJumpTest, TurnsUpTo150DegreesATickAreNone) {
  for (const float degrees : {30.0f, 120.0f, -120.0f, 145.0f}) {
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(tick({}, degrees).has_value()) << degrees;
  }
  for (const float degrees : {155.0f, 180.0f, -160.0f}) {
    const std::optional<RigidMotion> jump = tick({}, degrees);
    ASSERT_TRUE(jump.has_value()) << degrees;
    EXPECT_LT(length(jump->apply(previous.view()[1]) - next.view()[1]), 1e-5f);
  }
}

TEST_F(PinJumpTest, ASinglePinJumpsWithoutATurn) {
  previous.view().set(0, {0, 1, 0}), next.view().set(0, {0, 1, 100});
  PinJump one = job();
  one.count = 1, one.velocity = {0, 0, 100 / kTick};
  const std::optional<RigidMotion> jump = one.run();
  ASSERT_TRUE(jump.has_value());
  EXPECT_EQ(jump->rotation, Quaternion{});
  EXPECT_EQ(jump->to, (Vec3{0, 1, 100}));
}

}  // namespace
}  // namespace pleat
