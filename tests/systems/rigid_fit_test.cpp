#include "systems/rigid_fit.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pleat {
namespace {

Quaternion about(const Vec3& axis, float degrees) {
  const float half = degrees * 3.14159265f / 360.0f;
  const Vec3 v = normalized_or(axis, {0, 1, 0}) * std::sin(half);
  return {v.x, v.y, v.z, std::cos(half)};
}

/// Of arms that a rotation turns.
Quaternion fit(const std::vector<Vec3>& arms, const Quaternion& rotation) {
  PointPairs pairs;
  for (const Vec3& arm : arms) pairs.add(arm, rotate(rotation, arm));
  return best_rotation(pairs);
}

/// Between two rotations, degrees.
float angle(const Quaternion& p, const Quaternion& q) {
  const Quaternion turn = p * conjugate(q);
  const Vec3 axis{turn.x, turn.y, turn.z};
  return 2.0f * std::atan2(length(axis), std::abs(turn.w)) * 180.0f / 3.14159265f;
}

TEST(RigidFitProperty, FindsTheRotationOfAnyCloudOfPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  for (int run = 0; run < 200; ++run) {
    std::vector<Vec3> arms(3 + static_cast<std::size_t>(run % 9));
    for (Vec3& arm : arms) arm = {any(random), any(random), any(random)};
    const float degrees = run % 4 == 0 ? 180.0f : 180.0f * any(random);
    const Quaternion turn = about({any(random), any(random), any(random)}, degrees);
    EXPECT_LT(angle(fit(arms, turn), turn), 0.02f) << "run " << run;
  }
}

TEST(RigidFit, NoTurnIsNoTurn) {
  const std::vector<Vec3> arms = {{0.5f, 0, 0}, {-0.25f, 0, 0.4f}, {-0.25f, 0, -0.4f}};
  EXPECT_EQ(fit(arms, {}), Quaternion{});
}

TEST(RigidFit, PointsOnALineTurnTheShortestWay) {
  const std::vector<Vec3> arms = {{1, 0, 0}, {-1, 0, 0}};
  const Quaternion upright = about({0, 1, 0}, 70.0f);
  EXPECT_LT(angle(fit(arms, upright), upright), 0.02f);
  // A turn about the line itself cannot be seen.
  EXPECT_LT(angle(fit(arms, upright * about({1, 0, 0}, 40.0f)), upright), 0.02f);
}

TEST(RigidFit, PointsOnALineMakeHalfTurnsUpright) {
  const std::vector<Vec3> arms = {{1, 0, 0}, {-1, 0, 0}};
  EXPECT_LT(angle(fit(arms, about({0, 0, 1}, 180.0f)), about({0, 1, 0}, 180.0f)), 0.1f);
}

TEST(RigidFit, ASinglePointDoesNotTurn) {
  PointPairs pairs;
  pairs.add({}, {});
  EXPECT_EQ(best_rotation(pairs), Quaternion{});
}

}  // namespace
}  // namespace pleat
