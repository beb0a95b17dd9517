// Cloth in wind: gusts at any frame rate, storms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// Particles of a flag after `seconds` in gusts, at `rate` frames a second of 480 substeps in all.
std::vector<float> flag_in_gusts(int rate, float gust, std::uint32_t seed, int seconds = 2) {
  pleat_world_def def = Scene::default_def();
  def.wind[2] = 4.0f;
  def.gust = gust;
  def.gust_seed = seed;
  Scene scene(def);
  pleat_cloth_settings s = Scene::default_settings();
  s.drag_coefficient = 1.2f;
  s.lift_coefficient = 0.5f;
  s.substeps = static_cast<std::uint32_t>(480 / rate);
  const pleat_cloth cloth = scene.cloth(scene.sheet(6), s);
  scene.step(rate * seconds, 1.0f / static_cast<float>(rate));
  return scene.particles(cloth);
}

double apart(const std::vector<float>& a, const std::vector<float>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size() / 2; ++i) most = std::max(most, std::abs(static_cast<double>(a[i] - b[i])));
  return most;
}

TEST(Wind, GustsAreTheSameAtAnyFrameRate) {
  const std::vector<float> at_60 = flag_in_gusts(60, 3.0f, 1);
  for (const int rate : {30, 120, 240}) EXPECT_LT(apart(flag_in_gusts(rate, 3.0f, 1), at_60), 1e-4) << rate;
  EXPECT_GT(apart(flag_in_gusts(60, 0.0f, 1), at_60), 0.01) << "the flag does not feel them";
  EXPECT_GT(apart(flag_in_gusts(60, 3.0f, 2), at_60), 0.01) << "the seed does not matter";
}

TEST(Wind, GustsRunOnlyWhereThereIsSomethingToBlowAt) {
  Scene scene;
  pleat_cloth_settings s = Scene::default_settings();
  const pleat_cloth cloth = scene.cloth(scene.sheet(3), s);
  must(call::world_set_gust(scene, 2.0f, 1.0f, 0));
  EXPECT_TRUE(scene.explain("gust").ends_with("left out: drag_coefficient and lift_coefficient are 0"));
  s.lift_coefficient = 1.0f;
  must(call::cloth_set(scene, cloth, &s));
  EXPECT_TRUE(scene.explain("gust").ends_with("run"));
  EXPECT_TRUE(scene.explain("air_drag").ends_with("run"));
  must(call::world_set_gust(scene, 0.0f, 1.0f, 0));
  EXPECT_TRUE(scene.explain("gust").ends_with("left out: gust is 0"));
}

/// A sheet of a metre; where it flutters to is chance, its edges are torn to more than twice their length.
TEST(Wind, StormOfAThousandMetresASecondIsBorne) {
  for (const float dt : {1.0f / 30, 1.0f / 240}) {
    for (const float lift : {0.0f, 2.0f}) {
      for (const float share : {0.97f, 0.98f, 0.99f, 1.0f, 1.01f, 1.02f, 1.03f}) {
        pleat_world_def def = Scene::default_def();
        def.wind[0] = 600.0f * share, def.wind[1] = 500.0f * share, def.wind[2] = 620.0f * share;
        def.gust = 100.0f;
        Scene scene(def);
        pleat_cloth_settings s = Scene::default_settings();
        s.drag_coefficient = 1.28f;
        s.lift_coefficient = lift;
        const pleat_cloth cloth = scene.cloth(scene.sheet(6), s);
        for (int i = 0; i < 60; ++i) {
          scene.step(1, dt);
          const std::vector<float> state = scene.particles(cloth);
          for (std::size_t k = 0; k < state.size(); ++k) {
            ASSERT_TRUE(std::isfinite(state[k]));
            const bool is_position = k < state.size() / 2;
            ASSERT_LT(std::abs(state[k]), is_position ? 3.5f : 1500.0f) << k << " of tick " << i << " at " << share;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace pleat
