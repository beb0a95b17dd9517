// How far a triangle is from a capsule, tapered or not: what detection takes it for (the least over corners, edges and
// the core's ends over the face) against a search in double precision and against Bullet's GJK.
#include "systems/capsule_shape.h"

#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btMultiSphereShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace pleat {
namespace {

using Vec3d = Vec3T<double>;

struct Case {
  Vec3 x[3];
  CapsulePose capsule;
};

struct Separation {
  double distance;  // between the surfaces, m
  Vec3d normal;     // from the capsule to the triangle
  double from_core = 0.0;
};

Vec3d exact(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Of a triangle, the point nearest to p: within its sides, or on one of them.
Vec3d nearest_point(const Vec3d& p, const Vec3d (&x)[3]) {
  const Vec3d area = cross(x[1] - x[0], x[2] - x[0]);
  const double area2 = dot(area, area);
  bool over = area2 > 1e-24;
  for (int k = 0; k < 3; ++k) over = over && dot(cross(x[(k + 1) % 3] - x[k], p - x[k]), area) >= 0.0;
  if (over) return p - area * (dot(p - x[0], area) / area2);
  Vec3d best;
  double least = std::numeric_limits<double>::max();
  for (int k = 0; k < 3; ++k) {
    const Vec3d side = x[(k + 1) % 3] - x[k];
    const double s = std::clamp(dot(p - x[k], side) / std::max(dot(side, side), 1e-300), 0.0, 1.0);
    const Vec3d q = x[k] + side * s;
    if (length(p - q) < least) best = q, least = length(p - q);
  }
  return best;
}

/// The distance from the ball at t is convex in t: the interval shrinks around the least.
Separation search(const Case& c) {
  const Vec3d x[3] = {exact(c.x[0]), exact(c.x[1]), exact(c.x[2])}, a = exact(c.capsule.a), b = exact(c.capsule.b);
  const auto away = [&](double t) {
    const Vec3d ball = a + (b - a) * t;
    return nearest_point(ball, x) - ball;
  };
  const auto distance = [&](double t) {
    return length(away(t)) - (double{c.capsule.radius} + double{c.capsule.taper} * t);
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 90; ++i) {
    const double s = low + (high - low) * 0.382, t = high - (high - low) * 0.382;
    (distance(s) < distance(t) ? high : low) = distance(s) < distance(t) ? t : s;
  }
  double best = 0.5 * (low + high);
  for (const double end : {0.0, 1.0}) {
    if (distance(end) < distance(best)) best = end;
  }
  return {distance(best), normalized_or(away(best), Vec3d{}), length(away(best))};
}

Separation by_features(const Case& c) {
  Vec3 nearest;
  float least = std::numeric_limits<float>::max();
  const auto consider = [&](const Vec3& away, float t) {
    const float distance = length(away) - radius_at(c.capsule, t);
    if (distance < least) nearest = away, least = distance;
  };
  const auto core = [&](float t) { return lerp(c.capsule.a, c.capsule.b, t); };
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = c.x[k], q = c.x[(k + 1) % 3];
    const float t = closest_on_capsule(p, c.capsule);
    consider(p - core(t), t);
    EXPECT_NEAR(signed_distance(p, c.capsule), length(p - core(t)) - radius_at(c.capsule, t), 1e-6f);
    const SegmentPair at = closest_to_capsule(p, q, c.capsule);
    consider(lerp(p, q, at.s) - core(at.t), at.t);
  }
  for (const float t : {0.0f, 1.0f}) {
    consider(closest_on_triangle(core(t), c.x[0], c.x[1], c.x[2]).point(c.x[0], c.x[1], c.x[2]) - core(t), t);
  }
  return {double{least}, exact(normalized_or(nearest, Vec3{}))};
}

/// Random, and what is special: no taper, no radius, parallel to the core or to the wall, touching, without length,
/// without area, one ball within a hair of holding the other.
class Cases {
 public:
  Case next() {
    const Vec3 a = point(), b = point(), along = b - a;
    Case c{{point(), point(), point()}, {}};
    float taper = 0.1f * any(random_);
    c.capsule = {.a = a, .b = b, .step_a = {}, .step_b = {}, .radius = std::max(0.0f, -taper) + 0.05f, .taper = taper};
    switch (count_++ % 10) {
      case 1:
        c.capsule.taper = 0.0f;
        break;
      case 2:
        c.capsule.radius = std::max(0.0f, -taper);  // a cone
        break;
      case 3:
        c.x[1] = c.x[0] + along * any(random_);
        break;
      case 4: {  // an edge straight up the wall
        const Vec3 axis = normalized_or(along, {}), side = normalized_or(cross(axis, point()), {});
        c.x[0] = a + side * (c.capsule.radius + 0.02f);
        c.x[1] = b + side * (c.capsule.radius + taper + 0.02f);
        c.x[2] = c.x[0] + side;
        break;
      }
      case 5: {  // a corner that touches the wall, the face square to it
        const float t = 0.5f + 0.4f * any(random_);
        const Vec3 axis = normalized_or(along, {}), side = normalized_or(cross(axis, point()), {});
        const float lean = -taper / length(along);
        const Vec3 normal = side * std::sqrt(1.0f - lean * lean) + axis * lean;
        c.x[0] = lerp(a, b, t) + normal * radius_at(c.capsule, t);
        c.x[1] = c.x[0] + cross(normal, axis) + normal * 0.1f;
        c.x[2] = c.x[0] - cross(normal, axis) + normal * 0.1f;
        break;
      }
      case 6:
        c.capsule = {.a = a, .b = a, .step_a = {}, .step_b = {}, .radius = 0.1f};
        break;
      case 7:
        c.x[2] = c.x[1];
        break;
      case 8:
        c.x[1] = c.x[2] = c.x[0];
        break;
      case 9:
        c.capsule.taper = length(along) * (taper < 0.0f ? -0.999f : 0.999f);
        c.capsule.radius = std::max(0.0f, -c.capsule.taper) + 0.01f;
        break;
      default:
        break;
    }
    return c;
  }

 private:
  Vec3 point() { return {any(random_), any(random_), any(random_)}; }

  std::mt19937 random_{3};
  std::uniform_real_distribution<float> any{-1.0f, 1.0f};
  int count_ = 0;
};

TEST(CapsuleShape, TenThousandTrianglesAgreeWithASearchInDoublePrecision) {
  Cases cases;
  int apart = 0, touching = 0;
  for (int n = 0; n < 10000; ++n) {
    const Case c = cases.next();
    const Separation expected = search(c), ours = by_features(c);
    ASSERT_TRUE(std::isfinite(ours.distance)) << "case " << n;
    if (expected.from_core < 1e-3) continue;  // the core cuts the triangle: contact remembers which side is out
    ASSERT_NEAR(ours.distance, expected.distance, 3e-6) << "case " << n;
    touching += std::abs(expected.distance) < 1e-5;
    // Inside, several directions may be as near; outside, convex bodies have one.
    if (expected.distance < 1e-3) continue;
    ASSERT_GT(dot(ours.normal, expected.normal), 1.0 - 1e-5) << "case " << n;
    ++apart;
  }
  EXPECT_GT(apart, 7000);
  EXPECT_GT(touching, 500);
}

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Without EPA it has no answer where they overlap.
Separation gjk(const Case& c) {
  btTriangleShape triangle(to_bullet(c.x[0]), to_bullet(c.x[1]), to_bullet(c.x[2]));
  triangle.setMargin(0.0f);
  const Vec3 a = c.capsule.a, b = c.capsule.b;
  const btVector3 centers[] = {to_bullet(a), to_bullet(b)};
  const btScalar radii[] = {c.capsule.radius, radius_at(c.capsule, 1.0f)};
  btMultiSphereShape tapered(centers, radii, 2);
  tapered.setMargin(0.0f);
  btCapsuleShape plain(c.capsule.radius, length(b - a));  // along y
  btVoronoiSimplexSolver simplex;
  const bool is_plain = c.capsule.taper == 0.0f;
  btGjkPairDetector detector(&triangle, is_plain ? static_cast<btConvexShape*>(&plain) : &tapered, &simplex, nullptr);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformB.setIdentity();
  if (is_plain) {
    const Vec3 along = normalized_or(b - a, {0, 1, 0});
    input.m_transformB.setRotation(shortestArcQuat(btVector3(0, 1, 0), to_bullet(along)));
    input.m_transformB.setOrigin(to_bullet((a + b) * 0.5f));
  }
  btPointCollector result;
  detector.getClosestPoints(input, result, nullptr);
  const btVector3& n = result.m_normalOnBInWorld;
  return {result.m_hasResult ? double{result.m_distance} : -1.0, exact({n.x(), n.y(), n.z()})};
}

TEST(CapsuleShape, BulletsGjkAgrees) {
  Cases cases;
  int plain = 0, tapered = 0;
  for (int n = 0; n < 5000; ++n) {
    const Case c = cases.next();
    const Separation expected = gjk(c), ours = by_features(c);
    if (expected.distance < 0.01) continue;
    if (c.capsule.taper == 0.0f) {
      EXPECT_NEAR(ours.distance, expected.distance, 2e-4) << "case " << n;
      EXPECT_GT(dot(ours.normal, expected.normal), 0.999) << "case " << n;
      ++plain;
    } else {  // a core that is round stops GJK early: what it finds is an upper bound, and mostly close
      EXPECT_LT(ours.distance, expected.distance + 2e-4) << "case " << n;
      tapered += ours.distance > expected.distance - 2e-3;
    }
  }
  EXPECT_GT(plain, 500);
  EXPECT_GT(tapered, 2000);
}

}  // namespace
}  // namespace pleat
