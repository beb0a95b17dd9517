#include "systems/triangle_pairs.h"

#include <gtest/gtest.h>

#include <random>

namespace pleat {
namespace {

/// Points of all the kinds that matter: general, on a coarse lattice (so that parallel, touching, crossing, coincident
/// and flat triangles are frequent), and nearly on it.
struct Points {
  std::mt19937 random{11};
  Vec3 draw(int kind) {
    std::uniform_real_distribution<float> any(-1.0f, 1.0f), little(-1e-5f, 1e-5f);
    std::uniform_int_distribution<int> lattice(-1, 1);
    const auto one = [&] {
      return kind == 0 ? any(random) : static_cast<float>(lattice(random)) + (kind == 1 ? 0.0f : little(random));
    };
    return {one(), one(), one()};
  }
};

TEST(TrianglePairs, PropertyFourAtATimeAreAsOneByOneInEveryVectorSet) {
  for (const VectorSet set : kVectorSets) {
    if (set > widest_vectors()) continue;
    Points points;
    int on_face = 0, on_side = 0, flat = 0;
    for (int n = 0; n < 30000; ++n) {
      Vec3 p[4][3], q[4][3];
      Vec3Four first[3], second[3];
      for (std::size_t lane = 0; lane < 4; ++lane) {
        const Vec3 shift = n % 2 == 0 ? Vec3{} : Vec3{0.7f, 1.5f, 0.2f};  // near each other, crossing, and apart
        for (std::size_t k = 0; k < 3; ++k) {
          p[lane][k] = points.draw(n % 3), q[lane][k] = points.draw(n / 2 % 3) + shift;
          first[k].x[lane] = p[lane][k].x, first[k].y[lane] = p[lane][k].y, first[k].z[lane] = p[lane][k].z;
          second[k].x[lane] = q[lane][k].x, second[k].y[lane] = q[lane][k].y, second[k].z[lane] = q[lane][k].z;
        }
      }
      FourBarycentrics found[2];
      run_wide(set, [&] {
        const TrianglePairs pairs(first, second);
        found[0] = pairs.first, found[1] = pairs.second;
      });
      for (std::size_t lane = 0; lane < 4; ++lane) {
        const TrianglePair expected = closest_between_triangles(p[lane], q[lane]);
        const Barycentrics one = found[0][lane], other = found[1][lane];
        ASSERT_TRUE(one.a == expected.first.a && one.b == expected.first.b && one.c == expected.first.c)
            << "set " << static_cast<int>(set) << ", case " << n << ", lane " << lane;
        ASSERT_TRUE(other.a == expected.second.a && other.b == expected.second.b && other.c == expected.second.c)
            << "set " << static_cast<int>(set) << ", case " << n << ", lane " << lane;
        on_face += other.zeros() == 0, on_side += other.zeros() == 1;
        flat += length(cross(p[lane][1] - p[lane][0], p[lane][2] - p[lane][0])) == 0.0f;
      }
    }
    EXPECT_GT(on_face, 1000);
    EXPECT_GT(on_side, 1000);
    EXPECT_GT(flat, 1000);
  }
}

}  // namespace
}  // namespace pleat
