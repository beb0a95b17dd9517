#include "systems/closest_points.h"

#include <gtest/gtest.h>

#include <random>

namespace pleat {
namespace {

using Vec3d = Vec3T<double>;

Vec3d wide(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3d mix(const Vec3d& a, const Vec3d& b, double t) { return a + (b - a) * t; }

double point_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  const double l2 = dot(ab, ab), t = l2 > 0.0 ? std::clamp(dot(p - a, ab) / l2, 0.0, 1.0) : 0.0;
  return length(p - mix(a, b, t));
}

/// Least value of a function that is convex on [0, 1].
template <class F>
double least(const F& f) {
  double low = 0.0, high = 1.0, best = std::min(f(0.0), f(1.0));
  for (int i = 0; i < 90; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0, fa = f(a), fb = f(b);
    best = std::min({best, fa, fb});
    (fa < fb ? high : low) = fa < fb ? b : a;
  }
  return best;
}

/// Points of all the kinds that matter: general, on a coarse lattice (so that parallel, touching, crossing, coincident
/// and flat cases are frequent), and nearly on it.
struct Points {
  std::mt19937 random{7};
  Vec3 draw(int kind) {
    std::uniform_real_distribution<float> any(-1.0f, 1.0f), little(-1e-5f, 1e-5f);
    std::uniform_int_distribution<int> lattice(-1, 1);
    const auto one = [&] {
      return kind == 0   ? any(random)
             : kind == 1 ? static_cast<float>(lattice(random))
                         : static_cast<float>(lattice(random)) + little(random);
    };
    return {one(), one(), one()};
  }
};

TEST(ClosestPoints, SegmentsAgreeWithSearch) {
  Points points;
  for (int n = 0; n < 12000; ++n) {
    Vec3 p[4];
    for (Vec3& x : p) x = points.draw(n % 3);
    const SegmentPair at = closest_between_segments(p[0], p[1], p[2], p[3]);
    ASSERT_TRUE(at.s >= 0.0f && at.s <= 1.0f && at.t >= 0.0f && at.t <= 1.0f);
    const double found = length(wide(lerp(p[0], p[1], at.s)) - wide(lerp(p[2], p[3], at.t)));
    const double expected =
        least([&](double s) { return point_segment(mix(wide(p[0]), wide(p[1]), s), wide(p[2]), wide(p[3])); });
    ASSERT_NEAR(found, expected, 1e-6) << "case " << n;
  }
}

TEST(ClosestPoints, TriangleAgreesWithSearch) {
  Points points;
  for (int n = 0; n < 12000; ++n) {
    Vec3 p[4];
    for (Vec3& x : p) x = points.draw(n % 3);
    const Barycentrics at = closest_on_triangle(p[0], p[1], p[2], p[3]);
    ASSERT_TRUE(at.a >= 0.0f && at.b >= 0.0f && at.c >= 0.0f);
    ASSERT_NEAR(at.a + at.b + at.c, 1.0f, 1e-6f);
    const double found = length(wide(at.point(p[1], p[2], p[3])) - wide(p[0]));
    const double expected = least([&](double u) {
      return point_segment(wide(p[0]), mix(wide(p[1]), wide(p[3]), u), mix(wide(p[2]), wide(p[3]), u));
    });
    ASSERT_NEAR(found, expected, 1e-6) << "case " << n;
  }
}

TEST(ClosestPoints, TrianglesApartAgreeWithSearchOverTheirPointsAndEdges) {
  Points points;
  for (int n = 0; n < 3000; ++n) {
    Vec3 p[3], q[3];
    for (Vec3& x : p) x = points.draw(n % 3) + Vec3{0.0f, 2.5f, 0.0f};  // so that they never cross
    for (Vec3& x : q) x = points.draw(n % 3);
    const TrianglePair at = closest_between_triangles(p, q);
    const Vec3 found = at.first.point(p[0], p[1], p[2]) - at.second.point(q[0], q[1], q[2]);
    float expected = 1e9f;  // by alternating projections, which converge for convex sets
    Vec3 x = p[0];
    for (int i = 0; i < 3000; ++i) {
      const Vec3 y = closest_on_triangle(x, q[0], q[1], q[2]).point(q[0], q[1], q[2]);
      x = closest_on_triangle(y, p[0], p[1], p[2]).point(p[0], p[1], p[2]);
      const float now = length(x - y);
      if (expected - now < 1e-9f && i > 20) break;
      expected = std::min(expected, now);
    }
    ASSERT_LE(length(found), expected + 1e-5f) << "case " << n;
    ASSERT_GE(length(found), expected - 2e-3f) << "case " << n;  // the search stalls where they are nearly parallel
  }
}

TEST(ClosestPoints, ZeroWeightNamesTheFeature) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(closest_on_triangle({-1, -1, 1}, a, b, c).a, 1.0f);
  EXPECT_EQ(closest_on_triangle({0.5f, -1, 1}, a, b, c).c, 0.0f);
  EXPECT_EQ(closest_on_triangle({1, 1, 1}, a, b, c).a, 0.0f);
  const Barycentrics inside = closest_on_triangle({0.25f, 0.25f, 1}, a, b, c);
  EXPECT_TRUE(inside.a > 0.0f && inside.b > 0.0f && inside.c > 0.0f);
}

TEST(ClosestPoints, SegmentWithoutLengthIsItsPoint) {
  EXPECT_EQ(closest_on_segment({1, 2, 3}, {0, 0, 0}, {0, 0, 0}), 0.0f);
  EXPECT_EQ(closest_on_segment({3, 1, 0}, {0, 0, 0}, {2, 0, 0}), 1.0f);
  EXPECT_FLOAT_EQ(closest_on_segment({0.5f, 1, 0}, {0, 0, 0}, {2, 0, 0}), 0.25f);
}

}  // namespace
}  // namespace pleat
