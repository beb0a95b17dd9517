// The peer runs the scene that we run: the same fall, the same pins, the same bodies.
#include "bench/bullet_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "demo/input_error.h"
#include "demo/scenes/scene.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::bench {
namespace {

demo::SceneDef load(const char* name) {
  return demo::load_scene(*pleat_get_api(PLEAT_API_MAJOR),
                          {.scene = name, .clip = {}, .rate = 60.0, .frames = {}, .settings = {}});
}

float lowest(const std::vector<float>& positions) {
  float y = positions[1];
  for (size_t i = 1; i < positions.size(); i += 3) y = std::min(y, positions[i]);
  return y;
}

TEST(BulletScene, FallsAsAStoneDoes) {
  demo::SceneDef def = load("hanging_square:8");
  def.pins.clear();
  def.settings.air_damping = 0.0f;
  BulletScene scene(def, {});
  for (int frame = 0; frame < 30; ++frame) scene.advance();
  std::vector<float> now;
  scene.read_particles(0, now);
  for (size_t i = 1; i < now.size(); i += 3) {
    EXPECT_NEAR(now[i], def.garment.positions[i] - 0.5f * 9.81f * 0.25f, 0.05f) << "particle " << i / 3;
  }
}

TEST(BulletScene, PinsStandWhereOursStand) {
  const demo::SceneDef def = load("skirt_kick");
  BulletScene peer(def, {});
  demo::Scene ours(*pleat_get_api(PLEAT_API_MAJOR), def);
  std::vector<float> a, b;
  for (int frame = 0; frame < 20; ++frame) {
    peer.advance();
    ours.advance();
    peer.read_particles(0, a);
    ours.read_particles(0, b);
    for (const uint32_t pin : def.pins) {
      for (size_t c = 3 * pin; c < 3 * pin + 3; ++c) ASSERT_NEAR(a[c], b[c], 1e-6f);
    }
  }
}

TEST(BulletScene, IsHeldByASphere) {
  BulletScene scene(load("drape_sphere:16"), {.iterations = 10, .voxel_size = 0.05, .hardness = 1.0});
  std::vector<float> now;
  for (int frame = 0; frame < 60; ++frame) scene.advance();
  scene.read_particles(0, now);
  EXPECT_NEAR(now[3 * (8 * 16 + 8) + 1], 0.3f, 0.05f);  // the middle of the sheet lies on the pole, its border hangs
  EXPECT_LT(lowest(now), 0.1f);
}

TEST(BulletScene, RefusesBodiesThatItDoesNotRun) { EXPECT_THROW(BulletScene(load("drape_box"), {}), demo::InputError); }

}  // namespace
}  // namespace pleat::bench
