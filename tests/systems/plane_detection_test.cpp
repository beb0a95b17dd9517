#include "systems/plane_detection.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kThickness = 0.005f, kDt = 0.002f;

PlaneDetection detection(ContactCloth& cloth, const std::vector<PlaneCollider>& planes) {
  cloth.row_count = 0;
  return {3,
          cloth.position.view(),
          cloth.previous.view(),
          {},
          cloth.inverse_mass.data(),
          planes.data(),
          planes.size(),
          0.0f,
          1.0f,
          kThickness,
          0.5f,
          kDt,
          cloth.contacts()};
}

RigidPose random_pose(std::mt19937& random) {
  std::normal_distribution<float> any;
  Quaternion q{any(random), any(random), any(random), any(random)};
  const float scale = 1.0f / std::sqrt(dot(q, q));
  return {{any(random), any(random), any(random)}, {q.x * scale, q.y * scale, q.z * scale, q.w * scale}};
}

TEST(PlaneDetection, RowsTellHeightNormalAndMotionOfRandomPlanes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  int rows = 0;
  for (int n = 0; n < 2000; ++n) {
    PlaneCollider plane;
    plane.previous = random_pose(random);
    plane.next = n % 4 == 0 ? plane.previous : random_pose(random);
    plane.thickness = 0.01f;
    // In the plane's own frame, corners around its surface.
    const Vec3 local[3] = {{any(random), 0.02f * any(random), any(random)}, {any(random), 0.5f, 1}, {1, 0.6f, 0}};
    ContactCloth cloth({plane.next.apply(local[0]), plane.next.apply(local[1]), plane.next.apply(local[2])},
                       {{0, 1, 2}});
    Stats stats;
    const std::vector<PlaneCollider> planes = {plane};
    const PlaneDetection system = detection(cloth, planes);
    ASSERT_TRUE(system.validate());
    system.run(stats);
    ASSERT_EQ(cloth.row_count, local[0].y < 0.01f + kThickness + 0.01f ? 1u : 0u);
    if (cloth.row_count == 0) continue;
    ++rows;
    const ContactRow& row = cloth.rows[0];
    EXPECT_LT(length(row.normal - rotate(plane.next.rotation, {0, 1, 0})), 1e-5f);
    const Vec3 touched = {local[0].x, 0.01f, local[0].z};
    EXPECT_LT(length(row.body_step - (plane.next.apply(touched) - plane.previous.apply(touched))), 1e-5f);
    if (n % 4 != 0) continue;
    EXPECT_EQ(row.body_step, Vec3{});
    const float offset = dot(row.normal, plane.next.apply(touched)) + kThickness;
    const float recovered = dot(row.normal, cloth.x(0)) + 0.004f;  // 2 m/s for 2 ms
    EXPECT_NEAR(row.offset, std::min(offset, recovered), 1e-5f);
  }
  EXPECT_GT(rows, 1000);
}

TEST(PlaneDetection, TurnsAtAConstantRate) {
  PlaneCollider plane;
  plane.next.rotation = {0, 0, std::sin(0.6f), std::cos(0.6f)};  // by 1.2 rad about z
  for (const float t : {0.25f, 0.5f, 0.9f}) {
    const Vec3 normal = PlanePose(plane, t).normal;
    EXPECT_NEAR(normal.x, -std::sin(1.2f * t), 1e-6f);
    EXPECT_NEAR(normal.y, std::cos(1.2f * t), 1e-6f);
  }
}

TEST(PlaneDetection, DisabledPlanesAndPinnedParticlesMakeNoRows) {
  PlaneCollider off;
  off.enabled = false;
  ContactCloth cloth({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}}, {1});
  Stats stats;
  detection(cloth, {off}).run(stats);
  EXPECT_EQ(cloth.row_count, 0u);
  detection(cloth, {PlaneCollider{}}).run(stats);
  EXPECT_EQ(cloth.row_count, 2u);
  PlaneDetection bad = detection(cloth, {});
  bad.plane_count = 1, bad.planes = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = detection(cloth, {});
  bad.t1 = 0.0f;
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat::test
