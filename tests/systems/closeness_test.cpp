#include "systems/closeness.h"

#include <gtest/gtest.h>

#include <random>

#include "systems/closest_points.h"

namespace pleat {
namespace {

struct Four {
  Vec3 x[4];
};

class Closenesses : public testing::Test {
 protected:
  std::mt19937 random_{3};
  Four anywhere(float size) {
    std::uniform_real_distribution<float> place(-size, size);
    Four four;
    for (Vec3& p : four.x) p = {place(random_), place(random_), place(random_)};
    return four;
  }
};

float volume(NearKind kind, const Vec3 (&x)[4]) {
  return kind == NearKind::kParticleFace ? dot(x[0] - x[1], cross(x[2] - x[1], x[3] - x[1]))
                                         : dot(x[0] - x[2], cross(x[1] - x[0], x[3] - x[2]));
}

/// The nearest points, and whether both are well inside their features.
struct Nearest {
  float distance;
  bool inside;
};
Nearest nearest(NearKind kind, const Vec3 (&x)[4], float rim) {
  if (kind == NearKind::kParticleFace) {
    const Barycentrics at = closest_on_triangle(x[0], x[1], x[2], x[3]);
    return {length(at.point(x[1], x[2], x[3]) - x[0]), std::min({at.a, at.b, at.c}) > rim};
  }
  const SegmentPair at = closest_between_segments(x[0], x[1], x[2], x[3]);
  return {length(lerp(x[0], x[1], at.s) - lerp(x[2], x[3], at.t)),
          std::min({at.s, 1.0f - at.s, at.t, 1.0f - at.t}) > rim};
}

TEST_F(Closenesses, PropertyOfFeaturesAtRestIsTheDistanceOfTheirNearestPoints) {
  for (const NearKind kind : {NearKind::kParticleFace, NearKind::kEdges}) {
    int over = 0;
    for (int trial = 0; trial < 20000; ++trial) {
      const Four four = anywhere(0.1f);
      float side = 0.0f;
      Closeness c;
      const bool answer = closeness(kind, four.x, four.x, side, c);
      const Nearest found = nearest(kind, four.x, 1e-3f);
      if (!found.inside) continue;
      const Vec3 u = four.x[1] - four.x[0], v = four.x[3] - four.x[2];
      const float sine = length(cross(u, v)) / (length(u) * length(v));
      if (kind == NearKind::kEdges && sine < 0.11f) continue;
      ASSERT_TRUE(answer);
      ++over;
      EXPECT_NEAR(c.distance, found.distance, 2e-5f);
      EXPECT_NEAR(length(c.normal), 1.0f, 1e-5f);
      EXPECT_NEAR(c.weight[0] + c.weight[1] + c.weight[2] + c.weight[3], 0.0f, 1e-5f);
      EXPECT_EQ(side, volume(kind, four.x) < 0.0f ? -1.0f : 1.0f);
    }
    EXPECT_GT(over, 1000);
  }
}

/// Against many moments of the way: features that pass through each other are told from those that pass by.
TEST_F(Closenesses, PropertyWhatPassesThroughIsKnown) {
  constexpr int kMoments = 400;
  for (const NearKind kind : {NearKind::kParticleFace, NearKind::kEdges}) {
    int passed = 0, missed = 0, by = 0;
    for (int trial = 0; trial < 8000; ++trial) {
      const Four before = anywhere(0.05f);
      Four now = anywhere(0.02f);
      for (int k = 0; k < 4; ++k) now.x[k] += before.x[k];
      int changes = 0;
      bool through = false, clear = true;
      float v0 = volume(kind, before.x);
      for (int m = 1; m <= kMoments; ++m) {
        const float t = static_cast<float>(m) / kMoments;
        Four then;
        for (int k = 0; k < 4; ++k) then.x[k] = lerp(before.x[k], now.x[k], t);
        const float v = volume(kind, then.x);
        if ((v < 0.0f) == (v0 < 0.0f)) continue;
        v0 = v;
        ++changes;
        const bool inside = nearest(kind, then.x, 0.02f).inside;
        through = inside;
        clear = inside || nearest(kind, then.x, 0.0f).distance > 0.01f;  // nothing in between, at a rim
      }
      if (changes != 1 || !clear) continue;
      float side = 0.0f;
      Closeness c;
      const bool answer = closeness(kind, now.x, before.x, side, c);
      if (through) {
        const bool known = answer && side == (volume(kind, before.x) < 0.0f ? -1.0f : 1.0f);
        ++(known ? passed : missed);
        if (known) {
          EXPECT_LT(c.distance, 3e-4f);
        }
      } else {
        by += answer ? side == (volume(kind, now.x) < 0.0f ? -1.0f : 1.0f) : side == 0.0f;
      }
    }
    EXPECT_GT(passed, 100);
    EXPECT_LE(missed, passed / 50) << passed;  // edges that are nearly parallel as they meet
    EXPECT_GT(by, 100);
  }
}

TEST_F(Closenesses, AKnownSideIsKeptUntilTheFeaturesPartSideways) {
  const Vec3 face[3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  const auto at = [&](const Vec3& p) { return Four{{p, face[0], face[1], face[2]}}; };
  float side = 0.0f;
  Closeness c;
  const Four above = at({0.2f, 0.1f, 0.2f}), below = at({0.2f, -0.1f, 0.2f}), beside = at({-0.5f, -0.1f, 0.2f});
  ASSERT_TRUE(closeness(NearKind::kParticleFace, above.x, above.x, side, c));
  EXPECT_EQ(side, 1.0f);
  ASSERT_TRUE(closeness(NearKind::kParticleFace, below.x, below.x, side, c));
  EXPECT_EQ(side, 1.0f);
  EXPECT_NEAR(c.distance, -0.1f, 1e-6f);
  EXPECT_FALSE(closeness(NearKind::kParticleFace, beside.x, beside.x, side, c));
  EXPECT_EQ(side, 0.0f);
  ASSERT_TRUE(closeness(NearKind::kParticleFace, below.x, below.x, side, c));
  EXPECT_EQ(side, -1.0f);
}

TEST_F(Closenesses, WithoutExtentThereIsNone) {
  const Vec3 p{0.1f, 0.2f, 0.3f}, q{0.4f, 0.1f, 0.2f};
  Closeness c;
  for (const NearKind kind : {NearKind::kParticleFace, NearKind::kEdges}) {
    for (const Four& four : {Four{{p, p, p, p}}, Four{{p, q, q, q}}, Four{{p, p, q, q}}, Four{{p, q, p, q}}}) {
      for (float side : {0.0f, 1.0f}) {
        EXPECT_FALSE(closeness(kind, four.x, four.x, side, c));
        EXPECT_EQ(side, 0.0f);
      }
    }
  }
  const Four parallel{{{0, 0.01f, 0}, {1, 0.01f, 0}, {0, 0, 0}, {1, 0, 0.01f}}};
  float side = 1.0f;
  EXPECT_FALSE(closeness(NearKind::kEdges, parallel.x, parallel.x, side, c));
}

}  // namespace
}  // namespace pleat
