#include "demo/scenes/stage_clock.h"

#include <gtest/gtest.h>

namespace pleat::demo {
namespace {

TEST(StageClock, SpreadOfASeries) {
  EXPECT_EQ(spread_of({}).median, 0.0);
  EXPECT_EQ(spread_of({3.0, 1.0, 2.0}).median, 2.0);
  EXPECT_EQ(spread_of({4.0, 1.0, 2.0, 3.0}).median, 2.5);
  std::vector<double> hundred;
  for (int i = 100; i > 0; --i) hundred.push_back(i);
  const Spread spread = spread_of(hundred);
  EXPECT_EQ(spread.min, 1.0);
  EXPECT_EQ(spread.p99, 99.0);
}

TEST(StageClock, AddsUpTheCallsOfAFrameAndKeepsTheOrder) {
  StageClock clock;
  const auto run = [&clock](const char* system) {
    StageClock::on_stage(system, 1, &clock);
    StageClock::on_stage(system, 0, &clock);
  };
  run("surface");  // while the scene is made: no frame
  for (int frame = 0; frame < 3; ++frame) {
    clock.begin_frame();
    run("forces");
    run("stretch");
    run("forces");
    if (frame == 2) run("late");
    clock.end_frame();
  }
  ASSERT_EQ(clock.stages().size(), 3u);
  EXPECT_EQ(clock.stages()[0].name, "forces");
  EXPECT_EQ(clock.stages()[1].name, "stretch");
  EXPECT_EQ(clock.stages()[2].name, "late");
  for (const StageClock::Stage& stage : clock.stages()) EXPECT_EQ(stage.frames.size(), 3u) << stage.name;
  EXPECT_EQ(clock.stages()[2].frames[0], 0.0);
}

TEST(StageClock, AStageThatARunDidWithoutTookNothingThere) {
  std::vector<std::vector<StageClock::Stage>> runs = {
      {{"a", {1, 2}}, {"b", {3, 4}}}, {{"a", {5, 6}}, {"fade", {7, 8}}, {"b", {9, 10}}}, {{"b", {1, 1}}}};
  align(runs);
  const std::vector<double> b[] = {{3, 4}, {9, 10}, {1, 1}};
  for (size_t r = 0; r < runs.size(); ++r) {
    ASSERT_EQ(runs[r].size(), 3u);
    EXPECT_EQ(runs[r][0].name, "a");
    EXPECT_EQ(runs[r][1].name, "b");
    EXPECT_EQ(runs[r][2].name, "fade");
    EXPECT_EQ(runs[r][1].frames, b[r]);
  }
  EXPECT_EQ(runs[0][2].frames, (std::vector<double>{0, 0}));
  EXPECT_EQ(runs[2][0].frames, (std::vector<double>{0, 0}));
}

}  // namespace
}  // namespace pleat::demo
