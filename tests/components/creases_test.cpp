#include "components/creases.h"

#include <gtest/gtest.h>

#include "components/shapes.h"
#include "tests/components/cube.h"

namespace pleat {
namespace {

using Seam = std::array<std::uint32_t, 2>;

Garment sheet_with(std::span<const Seam> seams) {
  const Mesh mesh = make_grid({.rows = 3, .columns = 3});
  return build_garment({mesh.positions, mesh.triangles, {}, {}, seams}, std::pmr::new_delete_resource());
}

TEST(Creases, WithoutThemNormalsAreTheParticles) {
  const Garment g = sheet_with({});
  EXPECT_EQ(g.crease_count, 0u);
  EXPECT_EQ(g.normal_count, 9u);
  for (int k = 0; k < 3; ++k) {
    for (std::uint32_t f = 0; f < g.face_count; ++f) EXPECT_EQ(g.face_normal[k][f], g.face_particle[k][f]);
  }
  for (int k = 0; k < 2; ++k) {
    for (std::uint32_t e = 0; e < g.edge_count; ++e) EXPECT_EQ(g.edge_normal[k][e], g.edge_particle[k][e]);
  }
}

TEST(Creases, ALineFromBorderToBorderPartsTheFacesAroundEachOfItsParticles) {
  const Seam seams[] = {{3, 4}, {4, 5}};  // the middle row
  const Garment g = sheet_with(seams);
  EXPECT_EQ(g.crease_count, 2u);
  EXPECT_EQ((std::vector<std::uint32_t>(g.part_particle.begin(), g.part_particle.end())),
            (std::vector<std::uint32_t>{3, 3, 4, 4, 5, 5}));
  EXPECT_EQ(g.end_part[0].size(), 4u);
  EXPECT_EQ(g.normal_count, 9u + 6u + 4u);
  // Faces on the same side of the row share a normal there, others do not.
  for (std::uint32_t a = 0; a < g.face_count; ++a) {
    for (std::uint32_t b = 0; b < g.face_count; ++b) {
      const auto z_of = [&](std::uint32_t f) {
        float z = 0.0f;
        for (const auto& corner : g.face_particle) z += g.rest_position.view()[corner[f]].z;
        return z;
      };
      for (const auto& [at_a, of_a] : {std::pair(0, 0), std::pair(1, 1), std::pair(2, 2)}) {
        for (int at_b = 0; at_b < 3; ++at_b) {
          if (g.face_particle[at_a][a] != g.face_particle[at_b][b]) continue;
          const bool on_line = g.face_particle[at_a][a] / 3 == 1, same_side = (z_of(a) > 0) == (z_of(b) > 0);
          EXPECT_EQ(g.face_normal[of_a][a] == g.face_normal[at_b][b], !on_line || same_side);
        }
      }
    }
  }
}

TEST(Creases, OneThatEndsInTheClothFadesOutThere) {
  const Seam seams[] = {{1, 4}};
  const Garment g = sheet_with(seams);
  EXPECT_EQ(g.crease_count, 1u);
  EXPECT_EQ((std::vector<std::uint32_t>(g.part_particle.begin(), g.part_particle.end())),
            (std::vector<std::uint32_t>{1, 1}));
  EXPECT_EQ(g.end_part[0].size(), 1u);
}

TEST(Creases, ACubeIsCreasedAlongItsTwelveEdgesByAngle) {
  const Mesh mesh = make_cube();
  for (const auto& [angle, creases] : {std::pair(1.5f, 12u), std::pair(1.6f, 0u)}) {
    const Garment g =
        build_garment({mesh.positions, mesh.triangles, {}, {}, {}, angle}, std::pmr::new_delete_resource());
    EXPECT_EQ(g.crease_count, creases);
    EXPECT_EQ(g.part_particle.size(), 2 * creases);  // three at each corner
  }
}

}  // namespace
}  // namespace pleat
