#include "components/face_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory_resource>
#include <vector>

namespace pleat {
namespace {

Garment grid(std::uint32_t n) {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    x.push_back({static_cast<float>(i % n), static_cast<float>(i / n), 0});
    if (i % n == n - 1 || i / n == n - 1) continue;
    triangles.push_back({i, i + 1, i + n});
    triangles.push_back({i + 1, i + n + 1, i + n});
  }
  return build_garment({x, triangles, {}, {}, {}}, std::pmr::new_delete_resource());
}

TEST(FaceClusters, HoldEachFaceOnceAndLieTogether) {
  const Garment g = grid(17);
  std::vector<std::uint32_t> all(g.clustered_faces.begin(), g.clustered_faces.end());
  std::uint32_t begin = 0;
  for (const std::uint32_t end : g.cluster_end) {
    ASSERT_GT(end, begin);
    ASSERT_LE(end - begin, kFacesPerCluster);
    ASSERT_GE(end - begin, kFacesPerCluster / 2);
    float low[2] = {1e9f, 1e9f}, high[2] = {-1e9f, -1e9f};
    for (; begin < end; ++begin) {
      for (const auto& corner : g.face_particle) {
        const Vec3 p = g.rest_position.view()[corner[g.clustered_faces[begin]]];
        low[0] = std::min(low[0], p.x), low[1] = std::min(low[1], p.y);
        high[0] = std::max(high[0], p.x), high[1] = std::max(high[1], p.y);
      }
    }
    EXPECT_LE(high[0] - low[0] + high[1] - low[1], 5.0f);  // squares that four of them make are 2 x 2
  }
  EXPECT_EQ(begin, g.face_count);
  std::ranges::sort(all);
  for (std::uint32_t f = 0; f < g.face_count; ++f) EXPECT_EQ(all[f], f);
}

TEST(FaceClusters, FewFacesAreOne) {
  const Garment g = grid(3);
  ASSERT_EQ(g.cluster_end.size(), 1u);
  EXPECT_EQ(g.cluster_end[0], 8u);
}

TEST(FaceClusters, FacesInOnePlacePartToo) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 20; ++i) triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  std::vector<Vec3> x(60);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = {i % 3 == 1 ? 1.0f : 0.0f, i % 3 == 2 ? 1.0f : 0.0f, 0};
  const Garment g = build_garment({x, triangles, {}, {}, {}}, std::pmr::new_delete_resource());
  EXPECT_EQ(g.cluster_end.size(), 4u);
}

}  // namespace
}  // namespace pleat
