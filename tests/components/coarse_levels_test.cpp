#include "components/coarse_levels.h"

#include <gtest/gtest.h>

#include <set>

#include "components/garment.h"
#include "components/lanes.h"
#include "components/shapes.h"

namespace pleat {
namespace {

Garment garment_of(const Mesh& mesh, std::span<const std::uint32_t> pins) {
  return build_garment({mesh.positions, mesh.triangles, {}, pins, {}}, std::pmr::new_delete_resource());
}
Garment square(std::uint32_t side, std::span<const std::uint32_t> pins) {
  return garment_of(make_grid({.rows = side, .columns = side}), pins);
}

std::set<std::uint32_t> ends_of(const EdgeSlots& slots) {
  std::set<std::uint32_t> ends;
  for (const auto& column : slots.place) {
    for (const Vec4Place place : column) ends.insert(place.index());
  }
  std::erase_if(ends, [&](std::uint32_t i) { return i >= slots.empty_place; });
  return ends;
}

constexpr std::uint32_t kCorner[] = {0};

TEST(CoarseLevels, ShallowGarmentsHaveNone) {
  EXPECT_TRUE(square(kCoarseDepth, kCorner).coarse.empty());
  EXPECT_EQ(square(kCoarseDepth + 1, kCorner).coarse.size(), 1u);
  EXPECT_TRUE(square(3 * kCoarseDepth, {}).coarse.empty());
}

TEST(CoarseLevels, AreAThirdToASixthOfTheNextFinerOne) {
  const Garment g = square(70, kCorner);
  ASSERT_GE(g.coarse.size(), 2u);
  double finer = g.particle_count;
  for (std::size_t k = g.coarse.size(); k-- > 0;) {
    const double particles = static_cast<double>(ends_of(g.coarse[k].slots).size());
    EXPECT_LT(particles, finer / 2.5) << k;
    EXPECT_GT(particles, finer / 7.0) << k;
    finer = particles;
  }
}

/// Every particle but pins is a child once, or of the coarsest level.
void expect_all_found(const Garment& g) {
  std::multiset<std::uint32_t> found;
  for (const CoarseLevel& level : g.coarse) {
    for (std::size_t c = 0; c < level.child.size(); ++c) {
      if (level.child[c] != g.slots.empty_place) found.insert(level.child[c]);
    }
  }
  for (const std::uint32_t i : ends_of(g.coarse.front().slots)) found.insert(i);
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (g.pinned[i] != 0) continue;
    EXPECT_EQ(found.count(i), 1u) << i;
  }
}

TEST(CoarseLevels, EveryParticleButPinsIsAChildOnceOrOfTheCoarsestLevel) { expect_all_found(square(40, kCorner)); }

TEST(CoarseLevels, ParentsAreOfTheLevelAndShareTheirChildAmongThem) {
  const Garment g = square(40, kCorner);
  ASSERT_FALSE(g.coarse.empty());
  for (const CoarseLevel& level : g.coarse) {
    const std::set<std::uint32_t> of_level = ends_of(level.slots);
    ASSERT_EQ(level.child.size() % kLanes, 0u);
    for (std::size_t c = 0; c < level.child.size(); ++c) {
      float sum = 0.0f;
      for (std::size_t k = 0; k < kParents; ++k) {
        sum += level.weight[k][c];
        if (level.weight[k][c] != 0.0f) {
          EXPECT_TRUE(of_level.contains(level.parent[k][c])) << c;
        }
      }
      EXPECT_NEAR(sum, level.child[c] == g.slots.empty_place ? 0.0f : 1.0f, 1e-6f) << c;
    }
  }
}

TEST(CoarseLevels, EdgesAreWaysAlongEdgesNeverShorterThanStraight) {
  Mesh mesh = make_grid({.rows = 40, .columns = 40, .alternate = true});
  for (Vec3& p : mesh.positions) p.y = 0.2f * std::cos(6.0f * p.x);
  const Garment g = garment_of(mesh, kCorner);
  ASSERT_FALSE(g.coarse.empty());
  const ConstVec3View x = g.rest_position.view();
  for (const CoarseLevel& level : g.coarse) {
    for (std::uint32_t s = 0; s < level.slots.count; ++s) {
      const std::uint32_t i = level.slots.particle(0, s), j = level.slots.particle(1, s);
      if (i == g.slots.empty_place) continue;
      const float straight = length(x[i] - x[j]);
      EXPECT_GE(level.slots.rest_length[s], straight * 0.9999f);
      EXPECT_LE(level.slots.rest_length[s], 2.0f * straight);
    }
  }
}

TEST(CoarseLevels, PiecesWithoutPinsAreTakenAlong) {
  Mesh mesh = make_grid({.rows = 40, .columns = 40});
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Mesh other = make_grid({.rows = 5, .columns = 5});
  for (const Vec3& p : other.positions) mesh.positions.push_back(p + Vec3{3, 0, 0});
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  const Garment g = garment_of(mesh, kCorner);
  ASSERT_FALSE(g.coarse.empty());
  expect_all_found(g);
  for (const CoarseLevel& level : g.coarse) {
    for (const auto& column : level.weight) {
      for (const float weight : column) EXPECT_TRUE(weight >= 0.0f && weight < 1.000001f) << weight;
    }
  }
}

}  // namespace
}  // namespace pleat
