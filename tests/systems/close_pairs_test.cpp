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
  std::size_t looked = 0, left = 0, sides = 0, close_by = 0;
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
    const CloseOnes close = close_ones(kind, x, before, all(kMost), side);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      float expected = eight.side[lane];
      Closeness near;
      const bool over = closeness(kind, eight.x[lane], eight.before[lane], expected, near);
      if ((close.near >> lane & 1) != 0) {
        ++close_by;
        EXPECT_TRUE(over && near.distance <= kMost && (close.passed >> lane & 1) == 0);
        EXPECT_EQ(side[lane], expected);
        EXPECT_EQ((Vec3{close.normal.x[lane], close.normal.y[lane], close.normal.z[lane]}), near.normal);
        for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(close.weight[k][lane], near.weight[k]);
        continue;
      }
      if ((close.passed >> lane & 1) == 0) {
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
  EXPECT_GT(close_by, 1000u);
  EXPECT_GT(sides, 1000u);
}

/// Particles against the face of particles 2, 3 and 4.
struct Points {
  const Column<Vec4>& x;
  std::uint32_t corner[3] = {2, 3, 4};
  PairColumns columns_of(const NearPair&) const {
    PairColumns columns{{nullptr, &corner[0], &corner[1], &corner[2]}, {}, {}};
    columns.now.fill(x.data()), columns.before.fill(x.data());
    return columns;
  }
};

TEST(ClosePairs, AreVisitedInTheirOrderWhateverTheRunsOfTheirKinds) {
  Column<Vec4> x(std::pmr::new_delete_resource());
  x.resize(5);
  x[0] = {0, 0.001f, 0, 0}, x[1] = {0, 1, 0, 0}, x[2] = {-1, 0, -1, 0}, x[3] = {-1, 0, 2, 0}, x[4] = {2, 0, -1, 0};
  const Points points{x};
  for (const std::uint32_t count : {0u, 1u, 7u, 8u, 9u, 30u}) {
    std::vector<NearPair> pairs;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool close = i % 3 != 1;
      pairs.push_back({NearKind::kParticleFace, close ? 0u : 1u, 0, i / 5, 0.005f, 0.0f});
      if (close) expected.push_back(i);
    }
    std::uint32_t size = count;
    std::vector<std::uint32_t> visited;
    for_each_close_pair({pairs.data(), count, &size}, points, [&](const ClosePair& close) {
      visited.push_back(static_cast<std::uint32_t>(&close.pair - pairs.data()));
    });
    EXPECT_EQ(visited, expected);
    for (const NearPair& pair : pairs) EXPECT_EQ(std::abs(pair.side), 1.0f);
  }
}

}  // namespace
}  // namespace pleat::test
