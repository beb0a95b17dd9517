// The drawn surface of a cloth that lies on a box: sharp edges, and triangles larger than the cloth's.
#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_COLLISION
#ifdef PLEAT_WITH_SMOOTHING

namespace pleat {
namespace {

TEST(MeshClearance, AClothOnABoxIsDrawnOutsideItWithoutAllocating) {
  Scene scene;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8));
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def));
  def.shape = PLEAT_COLLIDER_BOX;
  def.position[1] = -0.35f;
  for (float& half : def.half_extents) half = 0.25f;
  pleat_collider box{};
  must(call::collider_create(scene, &def, &box));
  EXPECT_TRUE(scene.explain("mesh_clearance").ends_with("run"));

  float deepest = 0.0f;
  std::uint32_t touching = 0;
  scene.step();
  const std::uint64_t allocations = scene.stats().allocations;
  for (int tick = 0; tick < 60; ++tick) {
    scene.step();
    const std::vector<float> x = scene.vertices(cloth);
    for (std::size_t v = 0; v < x.size(); v += 8) {
      const float inside =
          std::min({0.25f - std::abs(x[v]), 0.25f - std::abs(x[v + 1] + 0.35f), 0.25f - std::abs(x[v + 2])});
      deepest = std::max(deepest, inside);
      touching += inside > -0.006f;
    }
  }
  EXPECT_GT(touching, 100u);
  EXPECT_LT(deepest, 1e-5f);
  EXPECT_EQ(scene.stats().allocations, allocations);
}

}  // namespace
}  // namespace pleat

#endif
#endif
