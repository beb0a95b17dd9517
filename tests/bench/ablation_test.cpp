#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/ablation/parts.h"
#include "bench/ablation/worth.h"
#include "demo/program/entry.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::bench {
namespace {

demo::SceneDef scene(std::vector<std::string> settings) {
  demo::SceneRequest request;
  request.scene = "hanging_square:3";
  request.frames = 30;
  request.settings = std::move(settings);
  return demo::load_scene(demo::library(), request);
}

const Part& part(std::string_view name) {
  for (const Part& p : parts()) {
    if (p.name == name) return p;
  }
  throw std::out_of_range(std::string(name));
}

TEST(Ablation, LeavesOutWhatTheSceneHas) {
  const Ablation sleep = ablate(scene({"sleep_speed=0.002"}), part("sleep"));
  EXPECT_FALSE(sleep.put_in);
  EXPECT_EQ(sleep.with.sleep_speed, 0.002f);
  EXPECT_EQ(sleep.without.sleep_speed, 0.0f);
}

TEST(Ablation, PutsInWhatTheSceneHasNot) {
  const Ablation sleep = ablate(scene({"sleep_speed=0"}), part("sleep"));
  EXPECT_TRUE(sleep.put_in);
  EXPECT_GT(sleep.with.sleep_speed, 0.0f);
  EXPECT_EQ(sleep.without.sleep_speed, 0.0f);
}

TEST(Ablation, WhatIsLeftOutIsMissed) {
  const SceneWorth worth = measure_worth(demo::library(), scene({}), 1, false, [] {});
  ASSERT_EQ(worth.parts.size(), parts().size());
  for (const Worth& w : worth.parts) {
    const std::string_view name = w.ablation.part->name;
    if (name == "strain limit, tethers") {
      EXPECT_GT(w.without.stretch_percent, w.with.stretch_percent);
      EXPECT_GT(w.apart_mm, 0.0);
    }
    if (name == "tangents") {
      EXPECT_LT(w.apart_mm, 1e-9);
    }
  }
}

}  // namespace
}  // namespace pleat::bench
