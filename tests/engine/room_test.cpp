// A cloth has the room of its own size, whatever a worker's scratch holds for larger ones.
#include <random>

#include "tests/engine/scene.h"

#ifdef PLEAT_WITH_COLLISION

namespace pleat {
namespace {

enum class Larger { kNone, kBeside, kGone };

struct Played {
  std::vector<float> particles, drawn;
  std::uint64_t dropped = 0;
};

/// A small sheet among overlapping bodies; alone, with a larger sheet 100 m away, or after one was destroyed.
Played play(std::uint32_t shape, int bodies, Larger larger) {
  Scene scene;
  pleat_cloth_settings settings = Scene::default_settings();
  settings.thickness = 0.02f;
  const pleat_cloth cloth = scene.cloth(scene.sheet(4), settings);
  std::mt19937 random(5);
  const auto draw = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 10001) / 10000.0f;
  };
  for (int k = 0; k < bodies; ++k) {
    pleat_collider_def def;
    must(call::collider_def_init(&def, sizeof def));
    def.shape = shape;
    for (float* at : {def.a, def.b, def.position}) {
      at[0] = draw(-0.5f, 0.5f), at[1] = draw(-0.9f, 0.1f), at[2] = draw(-0.5f, 0.5f);
    }
    def.radius = 0.27f;
    for (float& half : def.half_extents) half = draw(0.1f, 0.33f);
    pleat_collider body{};
    must(call::collider_create(scene, &def, &body));
  }
  if (larger != Larger::kNone) {
    const pleat_cloth other = scene.cloth(scene.sheet(30));
    const float here[] = {0, 0, 0}, there[] = {100, 0, 0};
    must(call::cloth_teleport(scene, other, here, there, nullptr));
    if (larger == Larger::kGone) must(call::cloth_destroy(scene, other));
  }
  Played played;
  for (int tick = 0; tick < 30; ++tick) {
    scene.step();
    const std::vector<float> particles = scene.particles(cloth), drawn = scene.vertices(cloth);
    played.particles.insert(played.particles.end(), particles.begin(), particles.end());
    played.drawn.insert(played.drawn.end(), drawn.begin(), drawn.end());
  }
  played.dropped = scene.stats().contacts_dropped;
  return played;
}

TEST(Room, IsTheClothsOwn) {
  for (const std::uint32_t shape : {std::uint32_t{PLEAT_COLLIDER_CAPSULE}, std::uint32_t{PLEAT_COLLIDER_BOX}}) {
    std::uint64_t dropped = 0;
    for (const int bodies : {20, 60, 120}) {
      const Played alone = play(shape, bodies, Larger::kNone);
      dropped += alone.dropped;
      for (const Larger larger : {Larger::kBeside, Larger::kGone}) {
        const Played played = play(shape, bodies, larger);
        EXPECT_TRUE(same_bits(played.particles, alone.particles)) << shape << " x " << bodies;
        EXPECT_TRUE(same_bits(played.drawn, alone.drawn)) << shape << " x " << bodies;
        EXPECT_EQ(played.dropped, alone.dropped);
      }
    }
    EXPECT_GT(dropped, 0u);  // rows overflow
  }
}

}  // namespace
}  // namespace pleat

#endif
