#include "components/tethers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "components/garment.h"
#include "tests/components/skirt.h"

namespace pleat {
namespace {

Garment garment_of(const Mesh& mesh, std::span<const std::uint32_t> pins = {}) {
  return build_garment({mesh.positions, mesh.triangles, {}, pins, {}}, std::pmr::new_delete_resource());
}
Garment square(std::uint32_t side, std::span<const std::uint32_t> pins) {
  return garment_of(make_grid({.rows = side, .columns = side}), pins);
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

TEST(Tethers, AreTheShortestWaysToTheNearestTwoPins) {
  const std::uint32_t corners[] = {0, 11, 143};
  const Garment g = square(12, corners);
  const std::vector<float> way = all_ways(g);
  std::vector<std::vector<float>> found(g.particle_count);
  for (std::size_t t = 0; t < g.tether_length.size(); ++t) {
    const std::uint32_t i = g.tether_particle[t], pin = g.tether_pin[t];
    EXPECT_NEAR(g.tether_length[t], way[i * g.particle_count + pin], 1e-5f);
    found[i].push_back(g.tether_length[t]);
  }
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    if (g.pinned[i]) {
      EXPECT_TRUE(found[i].empty());
      continue;
    }
    std::vector<float> ways;
    for (const std::uint32_t pin : corners) ways.push_back(way[i * g.particle_count + pin]);
    std::sort(ways.begin(), ways.end());
    ASSERT_EQ(found[i].size(), 2u);
    EXPECT_NEAR(found[i][0], ways[0], 1e-5f);
    EXPECT_NEAR(found[i][1], ways[1], 1e-5f);
  }
}

}  // namespace
}  // namespace pleat
