#ifdef PLEAT_WITH_COLLISION
#include <cmath>

#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

pleat_cloth_settings touching_itself(float distance = 0.01f) {
  pleat_cloth_settings s = Scene::default_settings();
  s.self_distance = distance;
  s.friction = 0.5f;
  return s;
}

/// A sheet of 11 x 11 whose outer halves are folded up and over, 12 mm above each other, held at its corners below.
std::vector<float> folded(std::uint32_t n) {
  std::vector<float> x;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const float u = static_cast<float>(i % n) / static_cast<float>(n - 1) - 0.5f;
    const float v = static_cast<float>(i / n) / static_cast<float>(n - 1) - 0.5f;
    x.insert(x.end(), {u > 0.0f ? -u : u, u > 0.0f ? 0.04f * std::min(1.0f, 10.0f * u) : 0.0f, v});
  }
  return x;
}

TEST(SelfContact, LeftOutUnlessAskedFor) {
  Scene scene;
  scene.cloth(scene.sheet(6));
  scene.step(2);
  EXPECT_TRUE(scene.explain("self_candidates").ends_with("left out: self_distance is 0"));
  EXPECT_TRUE(scene.explain("self_detection").ends_with("left out: self_distance is 0"));
  EXPECT_EQ(scene.inside().self.pairs.size(), 0u);
  EXPECT_EQ(scene.inside().workers[0].contacts.size(), 0u);
  Scene other;
  other.cloth(other.sheet(6), touching_itself());
  EXPECT_TRUE(other.explain("self_detection").ends_with("run"));
  EXPECT_TRUE(other.explain("collision_response").ends_with("run"));
}

TEST(SelfContact, AClothThatDoesNotTouchItselfMovesTheSame) {
  Scene scene;
  const pleat_garment garment = scene.sheet(8);
  pleat_cloth_settings off = touching_itself(0.0f);
  const pleat_cloth without = scene.cloth(garment, off), with = scene.cloth(garment, touching_itself());
  scene.step(20);
  EXPECT_EQ(scene.stats().self_contacts, 0u);
  EXPECT_TRUE(same_bits(scene.particles(without), scene.particles(with)));
}

TEST(SelfContact, AFoldedSheetComesToRest) {
  Scene scene;
  const pleat_garment garment = scene.sheet(11);
  const pleat_cloth cloth = scene.cloth(garment, touching_itself());
  const pleat_collider floor = scene.sphere(0, -50.005f, 0, 50.0f);
  (void)floor;
  const std::vector<float> start = folded(11);
  must(call::cloth_write_particles(scene, cloth, start.data(), nullptr, 121));
  scene.step(300);
  EXPECT_GT(scene.stats().self_contacts, 0u);
  EXPECT_EQ(scene.stats().contacts_dropped, 0u);
  const std::uint64_t before = scene.stats().allocations;
  double moved2 = 0.0;
  for (int tick = 0; tick < 60; ++tick) {
    const std::vector<float> from = scene.particles(cloth);
    scene.step();
    const std::vector<float> to = scene.particles(cloth);
    for (std::size_t k = 0; k < 3 * 121; ++k) moved2 += std::pow(to[k] - from[k], 2.0);
  }
  EXPECT_EQ(scene.stats().allocations, before);
  EXPECT_LT(1000.0 * std::sqrt(moved2 / (60 * 121)), 0.05);  // mm a frame
  // The upper half still lies on the lower one.
  const std::vector<float> x = scene.particles(cloth);
  for (std::uint32_t i = 0; i < 121; ++i) {
    const bool upper = i % 11 >= 7;
    EXPECT_TRUE(!upper || x[3 * i + 1] > 0.004f) << i << " at height " << x[3 * i + 1];
  }
}

TEST(SelfContact, MoreDistanceThanTheEdgesAllowIsNotKeptAndSaysSo) {
  std::string lines;
  pleat_world_def def = Scene::default_def();
  def.log = [](std::uint32_t, const char* line, void* user) { *static_cast<std::string*>(user) += line; };
  def.log_user = &lines;
  Scene scene(def);
  const pleat_garment garment = scene.sheet(11);
  const float most = 0.25f * scene.inside().garments[0]->garment.mean_edge_length;
  const pleat_cloth exact = scene.cloth(garment, touching_itself(most));
  EXPECT_EQ(lines, "");
  const pleat_cloth more = scene.cloth(garment, touching_itself(4.0f * most));
  EXPECT_NE(lines.find("self_distance is 0.11"), std::string::npos) << lines;
  const std::vector<float> start = folded(11);
  for (const pleat_cloth cloth : {exact, more}) {
    must(call::cloth_write_particles(scene, cloth, start.data(), nullptr, 121));
  }
  scene.step(30);
  EXPECT_GT(scene.stats().self_contacts, 0u);
  EXPECT_TRUE(same_bits(scene.particles(exact), scene.particles(more)));
}

TEST(SelfContact, SurvivesComingAndGoingOfCloths) {
  Scene scene;
  const pleat_garment garment = scene.sheet(8);
  const pleat_cloth first = scene.cloth(garment), second = scene.cloth(garment, touching_itself());
  Scene alone;
  const pleat_cloth same = alone.cloth(alone.sheet(8), touching_itself());
  scene.step(10), alone.step(10);
  must(call::cloth_destroy(scene, first));
  scene.cloth(garment, touching_itself(0.02f));
  scene.step(10), alone.step(10);
  EXPECT_TRUE(same_bits(scene.particles(second), alone.particles(same)));
}

}  // namespace
}  // namespace pleat
#endif
