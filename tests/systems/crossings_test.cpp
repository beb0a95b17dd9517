#include "systems/crossings.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

std::size_t crossings(const ContactCloth& edges, const ContactCloth& faces) {
  NearScratch scratch(memory());
  scratch.make_room(edges.garment.particle_count, edges.garment.edge_count);
  const Crossings search{
      {&edges.garment, edges.position.view()}, {&faces.garment, faces.position.view()}, &edges == &faces, &scratch};
  EXPECT_TRUE(search.validate());
  return search.run();
}

const std::vector<Vec3> kFace = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
const std::vector<Vec3> kTipThrough = {{0.2f, -0.03f, 0.2f}, {0.2f, 1, 0.3f}, {0.3f, 1, 0.2f}};

TEST(Crossings, ATipThroughAFaceIsTwoEdges) {
  const ContactCloth face(kFace, {{0, 1, 2}}), tip(kTipThrough, {{0, 1, 2}});
  EXPECT_EQ(crossings(tip, face), 2u);
  EXPECT_EQ(crossings(face, tip), 0u);
  std::vector<Vec3> both = kFace;
  both.insert(both.end(), kTipThrough.begin(), kTipThrough.end());
  const ContactCloth one(both, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(crossings(one, one), 2u);
}

TEST(Crossings, ApartSharingACornerOrWithoutAreaIsNone) {
  const ContactCloth face(kFace, {{0, 1, 2}});
  const ContactCloth above({{0.2f, 0.01f, 0.2f}, {0.2f, 1, 0.3f}, {0.3f, 1, 0.2f}}, {{0, 1, 2}});
  EXPECT_EQ(crossings(above, face), 0u);
  ContactCloth fold({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.9f, 0, 0.9f}}, {{0, 1, 2}, {1, 3, 2}});
  fold.put(3, {0.1f, 0, 0.1f}, {});
  EXPECT_EQ(crossings(fold, fold), 0u);
  ContactCloth flat(kTipThrough, {{0, 1, 2}});
  for (std::uint32_t i = 0; i < 3; ++i) flat.put(i, {0.2f, 0, 0.2f}, {});
  EXPECT_EQ(crossings(flat, face) + crossings(face, flat), 0u);
}

TEST(Crossings, PropertyTheGridMissesNone) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> place(-0.3f, 0.3f);
  std::vector<Vec3> positions(90);
  for (Vec3& p : positions) p = {place(random), place(random), place(random)};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 90; i += 3) triangles.push_back({i, i + 1, i + 2});
  const ContactCloth cloth(positions, triangles);
  std::size_t pairs = 0;  // one triangle at a time, where a grid is of no matter
  for (std::uint32_t e = 0; e < 90; e += 3) {
    const ContactCloth edges({positions[e], positions[e + 1], positions[e + 2]}, {{0, 1, 2}});
    for (std::uint32_t f = 0; f < 90; f += 3) {
      const ContactCloth face({positions[f], positions[f + 1], positions[f + 2]}, {{0, 1, 2}});
      if (e != f) pairs += crossings(edges, face);
    }
  }
  EXPECT_GT(pairs, 100u);
  EXPECT_EQ(crossings(cloth, cloth), pairs);
}

}  // namespace
}  // namespace pleat::test
