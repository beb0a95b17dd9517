// Boxes and hulls as cloth meets them: rows of mesh detection against Bullet's GJK on the same corners.
#include "systems/collision_hull.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <gtest/gtest.h>

#include <random>

#include "systems/mesh_detection.h"
#include "systems/mesh_pose.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kThickness = 0.005f, kDt = 0.002f;

std::vector<Vec3> random_points(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> any(-0.3f, 0.3f);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({any(random), any(random), any(random)});
  return points;
}

std::vector<Vec3> box_corners() { return box_shape({0.3f, 0.1f, 0.2f}).positions; }

RigidPose turned(std::mt19937& random) {
  std::normal_distribution<float> any;
  Quaternion q{any(random), any(random), any(random), any(random)};
  const float scale = 1.0f / std::sqrt(dot(q, q));
  return {{any(random), any(random), any(random)}, {q.x * scale, q.y * scale, q.z * scale, q.w * scale}};
}

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }

struct Separation {
  float distance;
  Vec3 normal;  // out of the hull
};

Separation gjk(const std::vector<Vec3>& x, const std::vector<Vec3>& points, const RigidPose& pose) {
  btTriangleShape triangle(to_bullet(x[0]), to_bullet(x[1]), to_bullet(x[2]));
  triangle.setMargin(0.0f);
  btConvexHullShape hull;
  for (const Vec3& p : points) hull.addPoint(to_bullet(pose.apply(p)));
  hull.setMargin(0.0f);
  btVoronoiSimplexSolver simplex;
  btGjkPairDetector detector(&triangle, &hull, &simplex, nullptr);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformB.setIdentity();
  btPointCollector result;
  detector.getClosestPoints(input, result, nullptr);
  const btVector3& n = result.m_normalOnBInWorld;
  return {result.m_hasResult ? result.m_distance : -1.0f, {n.x(), n.y(), n.z()}};
}

void detect(ContactCloth& cloth, const MeshCollider& body) {
  CollisionBodies bodies(memory());
  bodies.add_mesh(body);
  const MeshCollider* pointer = &body;
  cloth.row_count = 0;
  Stats stats;
  MeshDetection{&cloth.garment,
                cloth.position.view(),
                cloth.packed_position(),
                cloth.previous.view(),
                cloth.inverse_mass.data(),
                {},
                &bodies,
                &pointer,
                nullptr,
                0.0f,
                1.0f,
                kThickness,
                0.5f,
                kDt,
                cloth.contacts()}
      .run(stats);
}

/// A corner of the hull beside a side of the triangle makes no row: further in it is over a face, or edges cross.
bool corner_meets_side(const std::vector<Vec3>& x, const MeshCollider& hull, float distance) {
  for (std::size_t i = 0; i < hull.next.size(); ++i) {
    const Vec3 q = hull.next.view()[i];
    const Barycentrics at = closest_on_triangle(q, x[0], x[1], x[2]);
    const bool beside = at.a == 0.0f || at.b == 0.0f || at.c == 0.0f;
    if (beside && length(at.point(x[0], x[1], x[2]) - q) < distance + 1e-5f) return true;
  }
  return false;
}

TEST(CollisionHull, RowsOfRandomTrianglesAgreeWithBulletsGjk) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> gap(0.0012f, 0.01f);  // nearer ones are pushed out slowly: their rows are lower
  int compared = 0;
  for (int n = 0; n < 2500; ++n) {
    const std::vector<Vec3> points = n % 2 == 0 ? box_corners() : random_points(12, random);
    MeshCollider hull = build_hull(points, memory());
    const RigidPose pose = turned(random);
    place_rigid(hull, pose);
    std::vector<Vec3> x = random_points(3, random);
    for (Vec3& p : x) p = pose.position + p * 2.0f;
    const Separation apart = gjk(x, points, pose);
    if (apart.distance < 0.02f) continue;
    const float wanted = gap(random);
    for (Vec3& p : x) p -= apart.normal * (apart.distance - wanted);
    if (corner_meets_side(x, hull, wanted)) continue;
    ContactCloth cloth(x, {{0, 1, 2}});
    detect(cloth, hull);
    float least = 1.0f;
    Vec3 normal;
    for (std::uint32_t c = 0; c < cloth.row_count; ++c) {
      const ContactRow& row = cloth.rows[c];
      const float distance = dot(row.normal, contact_point(row, cloth.position.view())) - row.offset + kThickness;
      if (distance < least) least = distance, normal = row.normal;
    }
    EXPECT_NEAR(least, wanted, 5e-5f) << "case " << n;
    EXPECT_GT(dot(normal, apart.normal), 0.99f) << "case " << n;
    ++compared;
  }
  EXPECT_GT(compared, 700);
}

TEST(CollisionHull, AHullIsClosedConvexAndHasTheGivenCorners) {
  std::mt19937 random(2);
  for (const std::size_t count : {4u, 8u, 100u}) {
    const std::vector<Vec3> points = count == 8 ? box_corners() : random_points(count, random);
    const MeshCollider hull = build_hull(points, memory());
    const ConstVec3View x = hull.local.view();
    ASSERT_EQ(hull.triangles.size() / 3, 2 * hull.local.size() - 4);  // Euler
    for (std::size_t t = 0; t < hull.triangles.size(); t += 3) {
      const Vec3 a = x[hull.triangles[t]], b = x[hull.triangles[t + 1]], c = x[hull.triangles[t + 2]];
      const Vec3 normal = normalized_or(cross(b - a, c - a), {});
      for (const Vec3& p : points) EXPECT_LT(dot(normal, p - a), 1e-4f);
    }
    for (std::size_t i = 0; i < hull.local.size(); ++i) {
      EXPECT_NE(std::find(points.begin(), points.end(), x[i]), points.end());
    }
  }
}

TEST(CollisionHull, FlatPointsHaveNoTriangles) {
  EXPECT_EQ(build_hull(std::vector<Vec3>(6, Vec3{1, 2, 3}), memory()).triangles.size(), 0u);
  EXPECT_EQ(build_hull(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, memory()).triangles.size(), 0u);
  EXPECT_EQ(build_hull(std::vector<Vec3>{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, memory()).triangles.size(), 0u);
}

TEST(CollisionHull, ABoxMayBeAsThinAsItLikes) {
  for (const Vec3& half : {Vec3{1e3f, 1e-4f, 1e3f}, {1e4f, 1e-3f, 1e4f}, {1e-4f, 1e4f, 1e4f}, {1e4f, 1e-4f, 1e-4f}}) {
    MeshCollider box = build_box(half, memory());
    ASSERT_EQ(box.local.size(), 8u);
    ASSERT_EQ(box.triangles.size(), 36u);
    const ConstVec3View x = box.local.view();
    float area = 0.0f;  // twice, m2
    for (std::size_t t = 0; t < 36; t += 3) {
      const Vec3 a = x[box.triangles[t]], b = x[box.triangles[t + 1]], c = x[box.triangles[t + 2]];
      const Vec3 normal = cross(b - a, c - a);
      EXPECT_GT(dot(normal, a), 0.0f);  // outward
      area += length(normal);
    }
    EXPECT_NEAR(area / (16.0f * (half.x * half.y + half.y * half.z + half.z * half.x)), 1.0f, 1e-5f);
    if (half.y > 1.0f) continue;  // so high up a thickness is a few roundings
    place_rigid(box, {});
    const Vec3 at{0.3f * half.x, half.y + 0.5f * kThickness, 0.1f * half.z};
    ContactCloth cloth({at, at + Vec3{0.1f, 0, 0}, at + Vec3{0, 0, 0.1f}}, {{0, 2, 1}});
    detect(cloth, box);
    ASSERT_GT(cloth.row_count, 0u);
    EXPECT_GT(cloth.rows[0].normal.y, 0.999f) << half.x;
  }
}

TEST(CollisionHull, AParticleIsBroughtOutOfAnyDepth) {
  MeshCollider box = build_hull(box_corners(), memory());
  place_rigid(box, {{1, 2, 3}, {0, 0, 0.6f, 0.8f}});
  for (const float height : {0.09f, 0.05f, 0.01f}) {  // the nearest way out is up
    const Vec3 at = box.next_pose.apply({0.02f, height, 0.03f}), up = rotate(box.next_pose.rotation, {0, 1, 0});
    ContactCloth cloth({at, at + Vec3{1e-4f, 0, 0}, at + Vec3{0, 0, 1e-4f}}, {{0, 2, 1}});
    detect(cloth, box);
    ASSERT_GT(cloth.row_count, 0u) << height;
    EXPECT_GT(dot(cloth.rows[0].normal, up), 0.9999f) << height;
  }
}

TEST(CollisionHull, VerticesTurnOnCirclesWithinTheirSweptBoxes) {
  MeshCollider box = build_hull(box_corners(), memory());
  place_rigid(box, {});
  move_rigid(box, {{0.1f, 0, 0}, {0, 0, std::sin(0.7f), std::cos(0.7f)}});  // by 1.4 rad
  CollisionBodies bodies(memory());
  bodies.add_mesh(box);
  for (float t = 0.0f; t <= 1.0f; t += 0.125f) {
    const MeshPose pose{box, bodies.topology(0), 0.0f, t, {}};
    for (std::uint32_t v = 0; v < box.local.size(); ++v) {
      const Vec3 p = pose.vertex(v), local = box.local.view()[v];
      EXPECT_NEAR(length(p - Vec3{0.1f * t, 0, 0}), length(local), 1e-6f);
      EXPECT_LT(length(pose.step(v) - (p - local)), 1e-6f);
      EXPECT_TRUE((Box{p, p}.overlaps(bodies.swept_box(0))));
    }
  }
}

}  // namespace
}  // namespace pleat::test
