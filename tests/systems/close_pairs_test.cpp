#include "systems/close_pairs.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "systems/closeness.h"

namespace pleat::test {
namespace {

/// Eight pairs of a kind: random, some without extent, some on their way through each other.
struct Eight {
  Vec3 x[kLanes][4], before[kLanes][4];
  float side[kLanes];

  explicit Eight(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-0.1f, 0.1f), step(-0.03f, 0.03f);
    std::uniform_int_distribution<int> sides(-1, 1), one_in_eight(0, 7);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      for (std::size_t k = 0; k < 4; ++k) {
        x[lane][k] = {place(random), 0.2f * place(random), place(random)};
        before[lane][k] = x[lane][k] + Vec3{step(random), step(random), step(random)};
      }
      if (one_in_eight(random) == 0) x[lane][1] = x[lane][2] = x[lane][3];
      side[lane] = static_cast<float>(sides(random));
    }
  }
  static Vec3Lanes lanes(const Vec3 (&of)[kLanes][4], std::size_t k) {
    Vec3Lanes v;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      v.x[lane] = of[lane][k].x, v.y[lane] = of[lane][k].y, v.z[lane] = of[lane][k].z;
    }
    return v;
  }
};

TEST(ClosePairsProperty, WhoNeedNotBeLookedAtIsLeftAsClosenessLeavesIt) {
  std::mt19937 random(7);
  constexpr float kMost = 0.01f;
  std::size_t looked = 0, left = 0, sides = 0;
  for (int round = 0; round < 4000; ++round) {
    const NearKind kind = round % 2 == 0 ? NearKind::kParticleFace : NearKind::kEdges;
    const Eight eight(random);
    Lanes side;
    Vec3Lanes x[4];
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) side[lane] = eight.side[lane];
    for (std::size_t k = 0; k < 4; ++k) x[k] = Eight::lanes(eight.x, k);
    const auto before = [&](Vec3Lanes(&begin)[4]) {
      for (std::size_t k = 0; k < 4; ++k) begin[k] = Eight::lanes(eight.before, k);
    };
    const std::uint32_t close = close_ones(kind, x, before, all(kMost), side);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      float expected = eight.side[lane];
      Closeness near;
      const bool over = closeness(kind, eight.x[lane], eight.before[lane], expected, near);
      if ((close >> lane & 1) == 0) {
        ++left, sides += expected != eight.side[lane];
        EXPECT_EQ(side[lane], expected);
        EXPECT_TRUE(!over || near.distance > kMost);
        continue;
      }
      ++looked;
      float later = side[lane];
      Closeness again;
      EXPECT_EQ(closeness(kind, eight.x[lane], eight.before[lane], later, again), over);
      EXPECT_EQ(later, expected);
      if (over) {
        EXPECT_EQ(again.distance, near.distance);
      }
    }
  }
  EXPECT_GT(looked, 1000u);
  EXPECT_GT(left, 1000u);
  EXPECT_GT(sides, 1000u);
}

/// Pairs that stand side by side in a list, of numbered points.
struct Points {
  const std::vector<Vec3>& x;
  std::array<std::uint32_t, 4> corners_of(const NearPair& pair) const {
    return {pair.first, pair.second, pair.second + 1, pair.second + 2};
  }
  Vec3Lanes end(const NearPair&, std::uint32_t, const std::uint32_t* index) const {
    Vec3Lanes v;
    for (std::uint32_t k = 0; k < kLanes; ++k) v.x[k] = x[index[k]].x, v.y[k] = x[index[k]].y, v.z[k] = x[index[k]].z;
    return v;
  }
  Vec3Lanes begin(const NearPair& pair, std::uint32_t k, const std::uint32_t* index) const {
    return end(pair, k, index);
  }
};

TEST(ClosePairs, AreVisitedInTheirOrderWhateverTheRunsOfTheirKinds) {
  const std::vector<Vec3> x = {{0, 0.001f, 0}, {0, 1, 0}, {-1, 0, -1}, {-1, 0, 2}, {2, 0, -1}};
  for (const std::uint32_t count : {0u, 1u, 7u, 8u, 9u, 30u}) {
    std::vector<NearPair> pairs;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool close = i % 3 != 1;
      pairs.push_back({NearKind::kParticleFace, close ? 0u : 1u, 2, i / 5, 0.005f, 0.0f});
      if (close) expected.push_back(i);
    }
    std::uint32_t size = count;
    std::vector<std::uint32_t> visited;
    for_each_close_pair({pairs.data(), count, &size}, Points{x}, [&](const NearPair& pair) {
      visited.push_back(static_cast<std::uint32_t>(&pair - pairs.data()));
    });
    EXPECT_EQ(visited, expected);
    for (const NearPair& pair : pairs) EXPECT_EQ(std::abs(pair.side), 1.0f);
  }
}

}  // namespace
}  // namespace pleat::test
