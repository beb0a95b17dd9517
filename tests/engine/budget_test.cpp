// Level of detail by a budget: who gives up what, that nobody sees it happen, and that it is the same each time.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/counting_new.h"
#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr float kFrame = 1.0f / 30.0f;  // s

/// Three sheets that hang from two corners; the second is the most important.
struct Wardrobe {
  Scene scene;
  std::vector<pleat_cloth> cloths;

  explicit Wardrobe(const pleat_cloth_settings& settings = Scene::default_settings()) {
    const pleat_garment sheet = scene.sheet(7);
    for (const float importance : {1.0f, 5.0f, 2.0f}) {
      cloths.push_back(scene.cloth(sheet, settings));
      must(call::cloth_set_importance(scene, cloths.back(), importance));
    }
    tick(3);
  }
  void tick(int ticks) { scene.step(ticks, kFrame); }
  /// So much over the budget that all is given up; or so much below that all is taken back.
  void give_up() { keep(1.0f, 100.0f); }
  void take_back() { keep(100.0f, 1e-3f); }
  void keep(float budget, float cost, int calls = 40) {
    for (int i = 0; i < calls; ++i) must(call::world_keep_budget(scene, budget, cost));
  }
};

/// The largest way of a drawn vertex from one moment to the next, m.
float largest_move(const std::vector<float>& from, const std::vector<float>& to) {
  float most = 0.0f;
  for (std::size_t i = 0; i < from.size(); i += 8) {
    most = std::max(most, std::hypot(to[i] - from[i], to[i + 1] - from[i + 1], to[i + 2] - from[i + 2]));
  }
  return most;
}

TEST(Budget, SubstepsAreGivenUpAndTakenBack) {
  Wardrobe w;
  EXPECT_EQ(w.scene.info(w.cloths[0]).substeps, 12u);
  w.give_up();
  w.tick(1);
  EXPECT_EQ(w.scene.info(w.cloths[0]).substeps, 12u) << "not at once";
  w.tick(15);
  EXPECT_NEAR(w.scene.info(w.cloths[0]).substeps, 9.0, 1.0) << "a quarter within half a second";
  w.tick(48);
  for (const pleat_cloth cloth : w.cloths) EXPECT_EQ(w.scene.info(cloth).substeps, 3u);
  EXPECT_EQ(w.scene.stats().substeps_given_up, 3u);
  w.take_back();
  w.tick(51);
  for (const pleat_cloth cloth : w.cloths) EXPECT_EQ(w.scene.info(cloth).substeps, 12u);
  EXPECT_EQ(w.scene.stats().substeps_given_up, 0u);
  w.give_up();
  must(call::world_keep_budget(w.scene, 0.0f, 0.0f));
  EXPECT_EQ(w.scene.stats().substeps_given_up, 0u) << "without a budget nothing is given up";
}

TEST(Budget, TheLeastImportantGiveUpFirst) {
  Wardrobe w;
  w.keep(1.0f, 1.1f, 1);
  w.tick(30);
  EXPECT_LT(w.scene.info(w.cloths[0]).substeps, 12u);
  EXPECT_EQ(w.scene.info(w.cloths[1]).substeps, 12u);
  EXPECT_EQ(w.scene.info(w.cloths[2]).substeps, 12u);
}

TEST(Budget, TheMostImportantThatGiveAllUpAreAStateThatLoads) {
  Wardrobe w;
  for (const pleat_cloth cloth : w.cloths) must(call::cloth_set_importance(w.scene, cloth, 1e30f));
  w.give_up();
  EXPECT_EQ(w.scene.load(w.scene.saved()), pleat_result{PLEAT_OK});
}

TEST(Budget, WhereTicksDifferTheirMeanCounts) {
  Wardrobe w;
  w.tick(62);
  w.give_up();
  const auto tick = [&](float budget) {  // .2 ms whatever waits, and 1 us a unit of work
    w.tick(1);
    float cost = 0.2f;
    for (const ClothRecord& c : w.scene.inside().clothes) cost += c.carried ? 0.0f : 49e-3f * float(c.substeps_taken);
    must(call::world_keep_budget(w.scene, budget, cost));
    return cost;
  };
  float mean = 0.0f;
  for (int i = 0; i < 160; ++i) mean += tick(0.01f) / 160.0f;
  for (int i = 0; i < 160; ++i) tick(20.0f * mean);
  EXPECT_EQ(w.scene.stats().ticks_given_up, 0u);
}

TEST(Budget, SubstepsThatTheHostSetStay) {
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = 12;
  Wardrobe w(s);
  w.give_up();
  w.tick(30);
  EXPECT_EQ(w.scene.info(w.cloths[0]).substeps, 12u);
  EXPECT_EQ(w.scene.stats().substeps_given_up, 0u);
}

TEST(Budget, TheSameNumbersGiveTheSameBits) {
  const auto play = [](std::uint32_t workers) {
    pleat_world_def def = Scene::default_def();
    def.workers = workers;
    Scene scene(def);
    const pleat_garment sheet = scene.sheet(7);
    std::vector<pleat_cloth> cloths;
    for (int k = 0; k < 5; ++k) cloths.push_back(scene.cloth(sheet));
    std::vector<float> all;
    for (int frame = 0; frame < 40; ++frame) {
      scene.step(1, kFrame);
      must(call::world_keep_budget(scene, 1.0f, 1.0f + std::sin(0.3f * static_cast<float>(frame))));
      for (const pleat_cloth cloth : cloths) {
        const std::vector<float> drawn = scene.vertices(cloth);
        all.insert(all.end(), drawn.begin(), drawn.end());
      }
    }
    return all;
  };
  const std::vector<float> once = play(1);
  EXPECT_TRUE(same_bits(once, play(1)));
  EXPECT_TRUE(same_bits(once, play(3)));
}

TEST(Budget, AllocatesNothingAfterTheFirstCall) {
  Wardrobe w;
  w.give_up();
  w.tick(20);
  const std::uint64_t before = global_allocations(), counted = w.scene.stats().allocations;
  for (int i = 0; i < 60; ++i) {
    must(call::world_keep_budget(w.scene, 1.0f, i % 20 < 10 ? 0.1f : 3.0f));
    w.tick(1);
  }
  EXPECT_EQ(global_allocations(), before);
  EXPECT_EQ(w.scene.stats().allocations, counted);
}

TEST(Budget, ClothAtRestMovesSlowlyToItsNewSubsteps) {
  pleat_cloth_settings s = Scene::default_settings();
  s.air_damping = 2.0f;
  Wardrobe w(s);
  w.tick(300);
  const auto largest_step = [&](int ticks) {
    float most = 0.0f;
    for (int frame = 0; frame < ticks; ++frame) {
      const std::vector<float> before = w.scene.particles(w.cloths[0]);
      w.tick(1);
      const std::vector<float> after = w.scene.particles(w.cloths[0]);
      for (std::size_t i = 0; i < before.size() / 2; ++i) most = std::max(most, std::abs(after[i] - before[i]));
    }
    return most;
  };
  // At once it would be 20 mm.
  w.scene.inside().clothes[0].given_up = 3;
  EXPECT_LT(largest_step(60), 0.006f);
  w.scene.inside().clothes[0].given_up = 0;
  EXPECT_LT(largest_step(60), 0.006f);
  // All that there is, and slower in its own time.
  w.give_up();
  EXPECT_LT(largest_step(100), 0.011f);
  w.take_back();
  EXPECT_LT(largest_step(100), 0.011f);
}

#ifdef PLEAT_WITH_SMOOTHING
/// The highest fold of the first cloth, m.
float highest_fold(Scene& scene) {
  const World& world = scene.inside();
  const ClothRecord& cloth = world.clothes[0];
  float most = 0.0f;
  for (std::uint32_t e = 0; e < cloth.garment().edge_count; ++e) {
    most = std::max(most, std::abs(world.surface.fold_height[cloth.edge_begin + e]));
  }
  return most;
}

TEST(Budget, FoldsFadeAndComeBack) {
  pleat_cloth_settings s = Scene::default_settings();
  s.substeps = 8;           // only folds can be given up
  Wardrobe w(s), other(s);  // the other keeps everything
  w.tick(20), other.tick(20);
  ASSERT_GT(highest_fold(w.scene), 5e-3f);
  const auto apart = [&] { return largest_move(w.scene.vertices(w.cloths[0]), other.scene.vertices(other.cloths[0])); };
  w.give_up();
  EXPECT_EQ(w.scene.stats().folds_given_up, 3u);
  for (int frame = 1; frame <= 8; ++frame) {
    w.tick(1), other.tick(1);
    const float gone = std::min(kFoldsFade * kFrame * static_cast<float>(frame), 1.0f);
    EXPECT_LE(apart(), 1.01f * gone * highest_fold(other.scene)) << frame;
    EXPECT_GE(apart(), 0.5f * gone * highest_fold(other.scene)) << frame;
  }
  EXPECT_EQ(highest_fold(w.scene), 0.0f);
  EXPECT_NE(w.scene.explain("edge_length").find("given up for the budget"), std::string::npos);

  w.take_back();
  float last = apart();
  for (int frame = 1; frame <= 8; ++frame) {
    w.tick(1), other.tick(1);
    EXPECT_LT(std::abs(apart() - last), 0.3f * highest_fold(other.scene)) << frame;
    last = apart();
  }
  w.tick(60), other.tick(60);  // the sides to which edges fold agree again, too
  EXPECT_LT(apart(), 1e-6f);
  EXPECT_NE(w.scene.explain("fold_fade").find("drawn in full"), std::string::npos);
}
#endif

}  // namespace
}  // namespace pleat
