#include "components/pn_triangle.h"

#include <gtest/gtest.h>

#include <random>

#include "components/pn_edge.h"

namespace pleat {
namespace {

struct Random {
  std::mt19937 engine{7};
  std::normal_distribution<float> normal;
  Vec3 vector() { return {normal(engine), normal(engine), normal(engine)}; }
  Vec3 unit() { return normalized_or(vector(), {1, 0, 0}); }
  Vec3 tilted(const Vec3& up, float size) { return normalized_or(up + vector() * size, up); }
};

struct Patch {
  Vec3 p[3], n[3];
};

Patch random_patch(Random& r) {
  Patch t;
  for (int k = 0; k < 3; ++k) t.p[k] = r.vector();
  const Vec3 up = normalized_or(cross(t.p[1] - t.p[0], t.p[2] - t.p[0]), {0, 1, 0});
  for (int k = 0; k < 3; ++k) t.n[k] = r.tilted(up, 0.4f);
  return t;
}

Vec3 evaluate(const Patch& t, float a, float b, float c) {
  const float bary[3] = {a, b, c};
  return PnTriangle(t.p, t.n).point(bary, bend_weights(bary));
}

/// The ten control points and Bernstein polynomials, as the PN paper writes them.
Vec3 by_control_points(const Patch& t, float a, float b, float c) {
  const auto tangent = [&](int i, int j) {
    return (2.0f * t.p[i] + t.p[j] - t.n[i] * dot(t.p[j] - t.p[i], t.n[i])) * (1.0f / 3.0f);
  };
  const Vec3 b210 = tangent(0, 1), b120 = tangent(1, 0), b021 = tangent(1, 2), b012 = tangent(2, 1),
             b102 = tangent(2, 0), b201 = tangent(0, 2);
  const Vec3 mean = (b210 + b120 + b021 + b012 + b102 + b201) * (1.0f / 6.0f);
  const Vec3 b111 = mean + (mean - (t.p[0] + t.p[1] + t.p[2]) * (1.0f / 3.0f)) * 0.5f;
  return t.p[0] * (a * a * a) + t.p[1] * (b * b * b) + t.p[2] * (c * c * c) +
         3.0f * (b210 * (a * a * b) + b120 * (a * b * b) + b021 * (b * b * c) + b012 * (b * c * c) +
                 b102 * (c * c * a) + b201 * (c * a * a)) +
         b111 * (6.0f * a * b * c);
}

TEST(PnTriangle, EqualsTheTenControlPoints) {
  Random r;
  for (int i = 0; i < 1000; ++i) {
    const Patch t = random_patch(r);
    const float a = 0.1f + 0.05f * static_cast<float>(i % 10), b = 0.3f, c = 1.0f - a - b;
    EXPECT_LT(length(evaluate(t, a, b, c) - by_control_points(t, a, b, c)), 5e-6f);
  }
}

TEST(PnTriangle, InterpolatesCorners) {
  Random r;
  const Patch t = random_patch(r);
  EXPECT_EQ(evaluate(t, 1, 0, 0), t.p[0]);
  EXPECT_EQ(evaluate(t, 0, 1, 0), t.p[1]);
  EXPECT_EQ(evaluate(t, 0, 0, 1), t.p[2]);
}

TEST(PnTriangle, FlatFaceStaysFlat) {
  const Patch t{{{0, 0, 0}, {0.25f, 0, 0.5f}, {0.5f, 0, -0.25f}}, {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}};
  for (float a = 0.0f; a <= 1.0f; a += 0.125f) {
    const float b = (1.0f - a) * 0.375f, c = 1.0f - a - b;
    EXPECT_EQ(evaluate(t, a, b, c), t.p[0] * a + t.p[1] * b + t.p[2] * c);
  }
}

TEST(PnTriangle, SurfaceNormalAtACornerIsTheGivenOne) {
  Random r;
  for (int i = 0; i < 200; ++i) {
    const Patch t = random_patch(r);
    const float h = 1e-3f;  // one-sided, second order
    const Vec3 x = evaluate(t, 1, 0, 0);
    const Vec3 u = (evaluate(t, 1 - h, h, 0) - x) * 4.0f - (evaluate(t, 1 - 2 * h, 2 * h, 0) - x);
    const Vec3 v = (evaluate(t, 1 - h, 0, h) - x) * 4.0f - (evaluate(t, 1 - 2 * h, 0, 2 * h) - x);
    EXPECT_LT(std::abs(dot(normalized_or(u, {}), t.n[0])), 3e-3f);
    EXPECT_LT(std::abs(dot(normalized_or(v, {}), t.n[0])), 3e-3f);
  }
}

TEST(PnTriangle, PermutingCornersOrTurningSpaceChangesNothing) {
  Random r;
  for (int i = 0; i < 200; ++i) {
    const Patch t = random_patch(r);
    const Patch turned{{t.p[1], t.p[2], t.p[0]}, {t.n[1], t.n[2], t.n[0]}};
    const Patch mirrored{{t.p[1], t.p[0], t.p[2]}, {t.n[1], t.n[0], t.n[2]}};
    const Vec3 x = evaluate(t, 0.2f, 0.5f, 0.3f);
    EXPECT_LT(length(x - evaluate(turned, 0.5f, 0.3f, 0.2f)), 2e-6f);
    EXPECT_LT(length(x - evaluate(mirrored, 0.5f, 0.2f, 0.3f)), 2e-6f);

    const Vec3 e0 = r.unit(), e1 = normalized_or(cross(e0, r.unit()), {}), e2 = cross(e0, e1);
    const auto rotate = [&](const Vec3& v) { return e0 * v.x + e1 * v.y + e2 * v.z; };
    Patch rotated = t;
    for (int k = 0; k < 3; ++k) rotated.p[k] = rotate(t.p[k]), rotated.n[k] = rotate(t.n[k]);
    EXPECT_LT(length(rotate(x) - evaluate(rotated, 0.2f, 0.5f, 0.3f)), 1e-5f);
  }
}

TEST(PnTriangle, ItsSideIsThePnEdge) {
  Random r;
  for (int i = 0; i < 200; ++i) {
    const Patch t = random_patch(r);
    const PnEdge edge(t.p[0], t.p[1], t.n[0], t.n[1]);
    for (const float s : {0.1f, 0.5f, 0.8f}) EXPECT_LT(length(edge.point(s) - evaluate(t, 1 - s, s, 0)), 3e-6f);
    EXPECT_LT(length(edge.middle() - edge.point(0.5f)), 1e-6f);
    const Vec3 tangent = normalized_or(edge.point(0.505f) - edge.point(0.495f), {});
    EXPECT_GT(dot(tangent, normalized_or(edge.middle_tangent(), {})), 0.999f);
  }
}

TEST(PnEdge, LengthOfASymmetricArch) {
  // Length over chord for normals tilted outwards by alpha, from quadrature in double precision.
  for (const auto& [degrees, expected] : {std::pair{5.0f, 1.0013f},
                                          {11.25f, 1.0062f},
                                          {22.5f, 1.0217f},
                                          {30.0f, 1.0338f},
                                          {45.0f, 1.0510f},
                                          {90.0f, 1.0f}}) {
    const float alpha = degrees * 3.14159265f / 180.0f;
    const PnEdge c({0, 0, 0}, {2, 0, 0}, {-std::sin(alpha), std::cos(alpha), 0}, {std::sin(alpha), std::cos(alpha), 0});
    EXPECT_NEAR(curve_length(squared_speeds(c)) / 2.0f, expected, degrees == 90.0f ? 2e-3f : 1e-4f) << degrees;
  }
}

}  // namespace
}  // namespace pleat
