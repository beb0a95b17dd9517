#include "components/tethers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "components/garment.h"
#include "components/lanes.h"
#include "tests/components/skirt.h"

namespace pleat {
namespace {

Garment garment_of(const Mesh& mesh, std::span<const std::uint32_t> pins = {}) {
  return build_garment({mesh.positions, mesh.triangles, {}, pins, {}}, std::pmr::new_delete_resource());
}
Garment square(std::uint32_t side, std::span<const std::uint32_t> pins) {
  return garment_of(make_grid({.rows = side, .columns = side}), pins);
}

/// But for the empty ones that fill runs of lanes.
std::vector<std::size_t> tethers_of(const Garment& g) {
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < g.tether_length.size(); ++t) {
    if (g.tether_particle[t] != g.slots.empty_place) found.push_back(t);
  }
  return found;
}

/// All ways along the edges, one by one (Floyd, Warshall).
std::vector<float> all_ways(const Garment& g) {
  const std::size_t n = g.particle_count;
  std::vector<float> way(n * n, 1e9f);
  for (std::size_t i = 0; i < n; ++i) way[i * n + i] = 0.0f;
  for (std::size_t e = 0; e < g.edge_count; ++e) {
    const std::size_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    way[i * n + j] = way[j * n + i] = g.edge_rest_length[e];
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) way[i * n + j] = std::min(way[i * n + j], way[i * n + k] + way[k * n + j]);
    }
  }
  return way;
}

TEST(Tethers, DepthCountsEdgesToThePins) {
  const std::uint32_t corner[] = {0};
  EXPECT_EQ(square(9, corner).depth, 8u);  // diagonals reach the far corner, rows the others
  const std::uint32_t corners[] = {0, 8};
  EXPECT_EQ(square(9, corners).depth, 8u);
  const std::uint32_t loose = square(9, {}).depth;  // some corners are 16 edges apart, others 8
  EXPECT_TRUE(loose >= 4 && loose <= 8) << loose;
}

TEST(Tethers, ShallowGarmentsHaveNone) {
  const std::uint32_t corners[] = {0, 7};
  EXPECT_EQ(square(8, corners).tether_length.size(), 0u);
  EXPECT_EQ(garment_of(make_skirt()).tether_length.size(), 0u);
}

TEST(Tethers, LeadToTheNearestTwoPinsNearestFirst) {
  const std::uint32_t corners[] = {0, 11, 143};
  const Garment g = square(12, corners);
  std::vector<std::vector<float>> found(g.particle_count);
  for (const std::size_t t : tethers_of(g)) found[g.tether_particle[t]].push_back(g.tether_length[t]);
  const ConstVec3View x = g.rest_position.view();
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (g.pinned[i]) {
      EXPECT_TRUE(found[i].empty());
      continue;
    }
    std::vector<float> ways;
    for (const std::uint32_t pin : corners) ways.push_back(length(x[i] - x[pin]));
    std::sort(ways.begin(), ways.end());
    ASSERT_EQ(found[i].size(), 2u);
    EXPECT_NEAR(found[i][0], ways[0], 1e-5f);
    EXPECT_NEAR(found[i][1], ways[1], 1e-3f);  // through particles that may know nearer pins only
  }
}

TEST(Tethers, ARunOfLanesHasNoParticleTwice) {
  const std::uint32_t corners[] = {0, 11, 143};
  const Garment g = square(12, corners);
  ASSERT_EQ(g.tether_length.size() % kLanes, 0u);
  for (std::size_t run = 0; run < g.tether_length.size(); run += kLanes) {
    std::set<std::uint32_t> seen;
    for (std::size_t t = run; t < run + kLanes; ++t) {
      if (g.tether_particle[t] == g.slots.empty_place) continue;
      EXPECT_TRUE(seen.insert(g.tether_particle[t]).second) << t;
    }
  }
}

TEST(Tethers, AreStraightOnAFlatSheetHoweverItIsCut) {
  const std::uint32_t pins[] = {0, 10};
  for (const bool alternate : {false, true}) {
    Mesh sheet = make_grid({.rows = 14, .columns = 11, .width = 0.7f, .depth = 1.0f, .alternate = alternate});
    for (std::size_t i = 0; i < sheet.positions.size(); ++i) {
      Vec3& p = sheet.positions[i];
      const float k = static_cast<float>(i);  // inside the border no line is straight any more
      if (std::abs(p.x) < 0.34f && std::abs(p.z) < 0.49f) {
        p += {0.015f * std::sin(7.0f * k), 0.0f, 0.015f * std::cos(5.0f * k)};
      }
    }
    const Garment g = garment_of(sheet, pins);
    const ConstVec3View x = g.rest_position.view();
    ASSERT_EQ(tethers_of(g).size(), 2u * (g.particle_count - 2));
    for (const std::size_t t : tethers_of(g)) {
      const float straight = length(x[g.tether_particle[t]] - x[g.tether_pin[t]]);
      EXPECT_GE(g.tether_length[t], straight - 1e-5f);
      EXPECT_LE(g.tether_length[t], 1.006f * straight);
    }
  }
}

TEST(Tethers, GoAroundATubeTheShorterWay) {
  constexpr std::uint32_t kAround = 12, kRings = 12;
  std::array<Ring, kRings> rings;
  for (std::uint32_t r = 0; r < kRings; ++r) rings[r] = {kAround, 0.2f, -0.1f * static_cast<float>(r)};
  const std::uint32_t pins[] = {0};
  const Garment g = garment_of(make_rings(rings), pins);
  const float side = length(g.rest_position.view()[1] - g.rest_position.view()[0]);
  ASSERT_EQ(tethers_of(g).size(), g.particle_count - 1u);
  for (const std::size_t t : tethers_of(g)) {
    const std::uint32_t i = g.tether_particle[t] % kAround, ring = g.tether_particle[t] / kAround;
    const float across = side * static_cast<float>(std::min(i, kAround - i)), down = 0.1f * static_cast<float>(ring);
    EXPECT_NEAR(g.tether_length[t], std::hypot(across, down), 2e-5f) << i << " of ring " << ring;
  }
}

TEST(Tethers, OfADomeAreNoShorterThanStraightAndNoLongerThanItsEdges) {
  Mesh dome = make_grid({.rows = 13, .columns = 13});
  for (Vec3& p : dome.positions) p.y = 0.8f * std::cos(2.0f * p.x) * std::cos(2.0f * p.z);
  const std::uint32_t pins[] = {6};
  const Garment g = garment_of(dome, pins);
  ASSERT_EQ(tethers_of(g).size(), g.particle_count - 1u);
  const std::vector<float> along_edges = all_ways(g);
  const ConstVec3View x = g.rest_position.view();
  for (const std::size_t t : tethers_of(g)) {
    const std::uint32_t i = g.tether_particle[t], pin = g.tether_pin[t];
    EXPECT_GE(g.tether_length[t], length(x[i] - x[pin]));
    EXPECT_LE(g.tether_length[t], along_edges[i * g.particle_count + pin] + 1e-5f);
  }
}

}  // namespace
}  // namespace pleat
