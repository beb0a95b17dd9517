// A limb that crosses the cloth faster than substeps of the usual length can see.
#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_COLLISION

namespace pleat {
namespace {

constexpr float kSpeed = 20.0f, kRadius = 0.045f, kDt = 1.0f / 30;

/// A sheet that hangs from two corners, and a limb that goes up through it at 20 m/s and stops 12 cm above.
float cloth_above_limb(std::uint32_t substeps, std::uint64_t& fast_bodies, std::uint32_t& taken) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = substeps;
  const pleat_cloth cloth = scene.cloth(scene.sheet(8), s);
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def));
  float y = -0.55f;
  def.a[0] = -0.6f, def.b[0] = 0.6f;
  def.a[1] = def.b[1] = y;
  def.radius = kRadius;
  pleat_collider limb{};
  must(call::collider_create(scene, &def, &limb));
  taken = 0;
  for (int tick = 0; tick < 3; ++tick) {
    if (tick == 0) y += kSpeed * kDt;
    const float a[3] = {-0.6f, y, 0}, b[3] = {0.6f, y, 0};
    must(call::collider_move_capsule(scene, limb, a, b));
    scene.step(1, kDt);
    taken = std::max(taken, scene.info(cloth).substeps);
  }
  fast_bodies = scene.stats().fast_bodies;
  // The sheet's middle row lies along the limb: above it, or left behind below.
  const std::vector<float> x = scene.particles(cloth);
  float lowest = 1e9f;
  for (std::uint32_t c = 2; c < 6; ++c)
    lowest = std::min(lowest, std::max(x[3 * (3 * 8 + c) + 1], x[3 * (4 * 8 + c) + 1]));
  return lowest - y;
}

TEST(FastLimb, AtTwentyMetresASecondTakesTheClothAlong) {
  std::uint64_t fast_bodies = 0;
  std::uint32_t taken = 0;
  EXPECT_GT(cloth_above_limb(0, fast_bodies, taken), 0.0f);
  EXPECT_GT(taken, 16u);  // 1/30 s usually takes 16
  EXPECT_EQ(fast_bodies, 0u);
}

TEST(FastLimb, TooFewSubstepsBySettingAreReported) {
  std::uint64_t fast_bodies = 0;
  std::uint32_t taken = 0;
  cloth_above_limb(4, fast_bodies, taken);
  EXPECT_EQ(taken, 4u);
  EXPECT_GT(fast_bodies, 0u);
}

}  // namespace
}  // namespace pleat

#endif
