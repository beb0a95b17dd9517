// Pairs of features in a state that is loaded.
#ifdef PLEAT_WITH_COLLISION
#include <random>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

/// A cloth on another one over a ball, at rest: pairs are held from tick to tick.
struct TwoLayers : Scene {
  static pleat_world_def silent() {
    pleat_world_def def = default_def();
    def.log = [](std::uint32_t, const char*, void*) {};
    return def;
  }
  TwoLayers() : Scene(silent()) {
    sphere(0, -0.35f, 0, 0.3f);
    const pleat_garment garment = sheet(6);
    pleat_cloth_settings s = default_settings();
    cloth(garment, s);
    s.friction = 0.5f, s.layer = 1;
    cloth(garment, s);
    s.layer = 2;
    const pleat_cloth upper = cloth(garment, s);
    std::vector<float> at = particles(upper);
    at.resize(at.size() / 2);
    for (std::size_t i = 1; i < at.size(); i += 3) at[i] += 0.02f;
    must(call::cloth_write_particles(*this, upper, at.data(), nullptr, static_cast<std::uint32_t>(at.size() / 3)));
    step(200);
  }
  NearPair* pairs() {
    return inside().layers.pairs.data() + SelfColumns::kPairsPerParticle * inside().clothes.back().particle_begin;
  }
  std::uint32_t pair_count() { return inside().clothes.back().layer_pair_count; }
};

TEST(StatePairs, PairsWithNoLayerBelowOrOutOfOrderAreRefused) {
  TwoLayers scene;
  ASSERT_GT(scene.pair_count(), 1000u);
  const Bytes good = scene.saved();
  for (const std::uint32_t other : {0u, 2u}) {  // of no layer, the cloth itself
    const NearPair before = scene.pairs()[7];
    scene.pairs()[7].cloth = other;
    const Bytes bad = scene.saved();
    scene.pairs()[7] = before;
    EXPECT_EQ(scene.load(bad), pleat_result{PLEAT_ERROR_ARGUMENT}) << other;
  }
  const std::uint32_t last = scene.pair_count() - 1;
  ASSERT_NE(scene.pairs()[0].kind, scene.pairs()[last].kind);
  std::swap(scene.pairs()[0], scene.pairs()[last]);
  const Bytes bad = scene.saved();
  std::swap(scene.pairs()[0], scene.pairs()[last]);
  EXPECT_EQ(scene.load(bad), pleat_result{PLEAT_ERROR_ARGUMENT});
  EXPECT_EQ(scene.load(good), pleat_result{PLEAT_OK});
}

TEST(StatePairs, ThatSomeFoundNoRoomIsSaved) {
  TwoLayers scene;
  bool& cut = scene.inside().clothes.back().layers_sought.cut;
  EXPECT_FALSE(cut);
  cut = true;
  const Bytes state = scene.saved();
  cut = false;
  EXPECT_EQ(scene.load(state), pleat_result{PLEAT_OK});
  EXPECT_TRUE(cut);
}

TEST(StatePairs, PropertyAWorldTicksOnWithWhateverStateItTook) {
  TwoLayers scene;
  const Bytes good = scene.saved();
  std::mt19937 random(3);
  std::uniform_int_distribution<std::size_t> place(good.size() / 2, good.size() - 1);
  int taken = 0, refused = 0;
  for (int k = 0; k < 400; ++k) {
    Bytes state = good;
    state[place(random)] ^= static_cast<unsigned char>(1u << random() % 8);
    if (scene.load(state) == pleat_result{PLEAT_OK}) {
      ++taken;
      scene.step();
    } else {
      ++refused;
    }
  }
  EXPECT_GT(taken, 100);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace pleat
#endif
