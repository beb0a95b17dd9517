// Our closed forms against Bullet's GJK: the distance of a triangle from a capsule is the least over corners, edges and
// the capsule's ends over the face, which is what capsule detection tests.
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <gtest/gtest.h>

#include <random>

#include "systems/closest_points.h"

namespace pleat {
namespace {

constexpr float kRadius = 0.1f;
constexpr float kCut = 0.002f - kRadius;  // below it the core cuts the triangle, and GJK without EPA has no distance

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }

float gjk_distance(const Vec3 (&x)[3], const Vec3& a, const Vec3& b, float radius) {
  btTriangleShape triangle(to_bullet(x[0]), to_bullet(x[1]), to_bullet(x[2]));
  triangle.setMargin(0.0f);
  btCapsuleShape capsule(radius, length(b - a));  // along y
  btVoronoiSimplexSolver simplex;
  btGjkPairDetector detector(&triangle, &capsule, &simplex, nullptr);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA.setIdentity();
  const Vec3 along = normalized_or(b - a, {0, 1, 0});
  input.m_transformB.setIdentity();
  input.m_transformB.setRotation(shortestArcQuat(btVector3(0, 1, 0), to_bullet(along)));
  input.m_transformB.setOrigin(to_bullet((a + b) * 0.5f));
  btPointCollector result;
  detector.getClosestPoints(input, result, nullptr);
  return result.m_hasResult ? result.m_distance : -radius;
}

bool cuts(const Vec3 (&x)[3], const Vec3& a, const Vec3& b) {
  const Vec3 n = cross(x[1] - x[0], x[2] - x[0]);
  return dot(a - x[0], n) * dot(b - x[0], n) <= 0.0f;
}

float feature_distance(const Vec3 (&x)[3], const Vec3& a, const Vec3& b, float radius) {
  float best = 1e30f;
  for (int k = 0; k < 3; ++k) {
    const Vec3 xi = x[k], xj = x[(k + 1) % 3];
    const SegmentPair at = closest_between_segments(xi, xj, a, b);
    best = std::min(best, length(lerp(xi, xj, at.s) - lerp(a, b, at.t)));
  }
  for (const Vec3& end : {a, b}) {
    best = std::min(best, length(closest_on_triangle(end, x[0], x[1], x[2]).point(x[0], x[1], x[2]) - end));
  }
  return best - radius;
}

TEST(CollisionGjk, TriangleToCapsuleIsTheLeastOverFeatures) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  const auto point = [&] { return Vec3{any(random), any(random), any(random)}; };
  int compared = 0;
  for (int n = 0; n < 10000; ++n) {
    const Vec3 x[3] = {point(), point(), point()}, a = point(), b = point();
    const float ours = feature_distance(x, a, b, kRadius), expected = gjk_distance(x, a, b, kRadius);
    if (expected < kCut) {
      EXPECT_TRUE(ours < kCut + 0.001f || cuts(x, a, b)) << "case " << n;
      continue;
    }
    EXPECT_NEAR(ours, expected, 2e-4f) << "case " << n;
    ++compared;
  }
  EXPECT_GT(compared, 5000);
}

}  // namespace
}  // namespace pleat
