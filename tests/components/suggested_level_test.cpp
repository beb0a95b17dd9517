#include "components/suggested_level.h"

#include <gtest/gtest.h>

#include <cmath>

#include "components/base_normal.h"
#include "components/creases.h"
#include "components/pn_edge.h"
#include "components/shapes.h"
#include "components/tessellation_pattern.h"
#include "tests/components/cube.h"

namespace pleat {
namespace {

constexpr float kPi = 3.14159265f;

/// A tube of radius 1 of `facets` facets as high as they are wide, with exact normals.
struct Tube {
  Garment garment;
  Vec3Column normal{std::pmr::new_delete_resource()};

  explicit Tube(std::uint32_t facets) : garment(std::pmr::new_delete_resource()) {
    const float side = 2.0f * std::sin(kPi / static_cast<float>(facets));
    const Mesh mesh = make_rings(std::array{Ring{facets, 1.0f, 0.0f}, Ring{facets, 1.0f, side}});
    garment = build_garment({mesh.positions, mesh.triangles, {}, {}, {}}, std::pmr::new_delete_resource());
    normal.resize(garment.normal_count);
    for (std::uint32_t i = 0; i < garment.particle_count; ++i) {
      const Vec3 x = mesh.positions[i];
      normal.view().set(i, {x.x, 0.0f, x.z});
    }
  }
  float bend() const { return largest_bend(garment, garment.rest_position.view(), normal.view(), nullptr); }
};

TEST(SuggestedLevel, BendOfAnArcIsItsChordTimesItsTurn) {
  for (const std::uint32_t facets : {12u, 24u, 48u}) {
    const float turn = 2.0f * kPi / static_cast<float>(facets), chord = 2.0f * std::sin(0.5f * turn);
    const float ratio = Tube(facets).bend() / (chord * turn);
    EXPECT_GT(ratio, 0.99f) << facets;
    EXPECT_LT(ratio, 1.0f + turn * turn) << facets;  // the bound counts bending along the chord too
  }
}

TEST(SuggestedLevel, BetweenCreasesASurfaceIsAsFlatAsItsFaces) {
  const Mesh cube = make_cube();
  for (const float crease_angle : {1.0f, 3.0f}) {
    const Garment g =
        build_garment({cube.positions, cube.triangles, {}, {}, {}, crease_angle}, std::pmr::new_delete_resource());
    Vec3Column normal(std::pmr::new_delete_resource());
    normal.resize(g.normal_count);
    const ConstVec3View x = g.rest_position.view();
    for (std::uint32_t f = 0; f < g.face_count; ++f) {
      const auto corner = [&](std::size_t k) { return x[g.face_particle[k][f]]; };
      for (const auto& of : g.face_normal)
        normal.view().add(of[f], cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    complete_normals(g, normal.view());
    normalize(normal.view(), g.normal_count);
    const float bend = largest_bend(g, x, normal.view(), nullptr);
    EXPECT_EQ(bend < 1e-6f, crease_angle == 1.0f) << bend;
  }
}

TEST(SuggestedLevel, ChordsOfATubeStayWithinHalfAPixelAndNoLevelLessDoes) {
  // n chords over a turn of a on a circle of radius 1 miss it by 1 - cos(a / 2n).
  for (const std::uint32_t facets : {16u, 32u, 64u}) {
    const Tube tube(facets);
    const double turn = 2.0 * static_cast<double>(kPi) / facets;
    const auto missed = [&](std::uint32_t level, float pixels) {
      return static_cast<double>(pixels) * (1.0 - std::cos(turn / (4.0 * level)));
    };
    for (float pixels = 20.0f; pixels < 3000.0f; pixels *= 1.5f) {
      const std::uint32_t level = suggested_level(tube.bend(), 10.0f, pixels);
      EXPECT_TRUE(level == 8 || missed(level, pixels) <= 0.5) << facets << " facets, " << pixels;
      EXPECT_TRUE(level == 1 || missed(level - 1, pixels) > 0.42) << facets << " facets, " << pixels;
    }
  }
}

TEST(SuggestedLevel, AFoldIsFollowedAsClosely) {
  // The fold over a straight edge, from its own shape: the largest distance from its chords.
  for (const float height : {0.01f, 0.05f, 0.2f}) {
    for (const float pixels : {50.0f, 200.0f, 800.0f}) {
      const std::uint32_t level = suggested_level(24.0f * height, 10.0f, pixels), n = 2 * level;
      if (level == 8) continue;
      double worst = 0.0;
      for (int i = 0; i < 1000; ++i) {
        const float t = static_cast<float>(i) * 1e-3f, at = t * static_cast<float>(n), left = std::floor(at);
        const float a = fold_shape(left / static_cast<float>(n)), b = fold_shape((left + 1.0f) / static_cast<float>(n));
        worst = std::max(worst, static_cast<double>(height * std::abs(fold_shape(t) - a - (b - a) * (at - left))));
      }
      EXPECT_LE(worst * static_cast<double>(pixels), 0.5) << height << " m, " << pixels;
    }
  }
}

TEST(SuggestedLevel, FlatOrFarAwayIsOneAndItGrowsWithThePicture) {
  EXPECT_EQ(suggested_level(0.0f, 0.1f, 1e6f), 1u);
  EXPECT_EQ(suggested_level(0.1f, 0.1f, 1.0f), 1u);
  EXPECT_EQ(suggested_level(1e3f, 1e3f, 1e6f), kMaxTessellationLevel);
  std::uint32_t last = 1;
  for (float pixels = 1.0f; pixels < 1e5f; pixels *= 1.1f) {
    const std::uint32_t level = suggested_level(0.05f, 0.1f, pixels);
    EXPECT_GE(level, last);
    last = level;
    EXPECT_TRUE(level == 1 || 0.1f * pixels >= 4.0f * static_cast<float>(2 * level));  // 4 pixels a segment
  }
  EXPECT_EQ(last, kMaxTessellationLevel);
}

}  // namespace
}  // namespace pleat
