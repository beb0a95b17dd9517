#include "systems/detail_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace pleat {
namespace {

/// Cloths of 100 units of work, of which 10, then 40, then 20 can be given up.
struct Crowd {
  std::vector<DetailCandidate> candidates;
  std::vector<std::uint32_t> order;

  explicit Crowd(const std::vector<float>& importance) : order(importance.size()) {
    for (const float value : importance) {
      candidates.push_back({.importance = value, .work = {100.0f, 90.0f, 50.0f, 30.0f}});
    }
  }
  DetailChoice job(float budget, float pace) {
    return {.candidates = candidates, .order = order, .budget = budget, .pace = pace};
  }
  /// When a tick takes `cost` now.
  float run(float budget, float cost) { return job(budget, cost / work()).run(); }
  float work() const {
    float sum = 0.0f;
    for (const DetailCandidate& c : candidates) sum += c.work_now();
    return sum;
  }
  std::vector<std::uint32_t> given_up() const {
    std::vector<std::uint32_t> steps;
    for (const DetailCandidate& c : candidates) steps.push_back(c.given_up);
    return steps;
  }
};
using Steps = std::vector<std::uint32_t>;

TEST(DetailChoice, RefusesWhatMakesNoSense) {
  Crowd crowd({1, 2});
  const DetailChoice good = crowd.job(1.0f, 2.0f);
  EXPECT_TRUE(good.validate());
  DetailChoice bad = good;
  bad.order = bad.order.first(1);
  EXPECT_FALSE(bad.validate());
  bad = good, bad.budget = 0.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.pace = -1.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.pace = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(bad.validate());
  crowd.candidates[1].given_up = kMostGivenUp + 1;
  EXPECT_FALSE(good.validate());
}

TEST(DetailChoice, WithinTheBudgetAllKeepTheirDetail) {
  Crowd crowd({1, 2, 3});
  EXPECT_FLOAT_EQ(crowd.run(10.0f, 9.9f), 9.9f);
  EXPECT_EQ(crowd.given_up(), (Steps{0, 0, 0}));
}

TEST(DetailChoice, TheLeastImportantGiveUpFirstAndNoMoreThanIsNeeded) {
  Crowd crowd({3, 1, 2});
  // 300 units in 3 ms: 2.6 ms leave 247 units, that is, 53 less. The second has 70 to give, of which 50 are not enough.
  EXPECT_NEAR(crowd.run(2.6f, 3.0f), 2.3f, 1e-5f);
  EXPECT_EQ(crowd.given_up(), (Steps{0, 3, 0}));
  EXPECT_NEAR(crowd.run(2.0f, 2.3f), 1.8f, 1e-5f);
  EXPECT_EQ(crowd.given_up(), (Steps{0, 3, 2}));
}

TEST(DetailChoice, WhatCannotBeKeptIsKeptAsNearlyAsPossible) {
  Crowd crowd({1, 1, 1});
  EXPECT_NEAR(crowd.run(0.1f, 3.0f), 0.9f, 1e-5f);
  EXPECT_EQ(crowd.given_up(), (Steps{3, 3, 3}));
}

TEST(DetailChoice, TheMostImportantTakeBackFirst) {
  Crowd crowd({3, 1, 2});
  crowd.run(0.1f, 3.0f);
  EXPECT_NEAR(crowd.run(1.9f, 0.9f), 1.6f, 1e-5f);  // 70 units fit under 1.71 ms, the next 20 would not
  EXPECT_EQ(crowd.given_up(), (Steps{0, 3, 3}));
  crowd.run(100.0f, 1.6f);
  EXPECT_EQ(crowd.given_up(), (Steps{0, 0, 0}));
}

TEST(DetailChoice, AStepThatSavesNothingIsPassedOver) {
  Crowd crowd({1, 2});
  crowd.candidates[0].work = {100.0f, 100.0f, 50.0f, 50.0f};
  crowd.candidates[1].work = {};  // asleep
  crowd.run(0.1f, 1.0f);
  EXPECT_EQ(crowd.given_up(), (Steps{2, 0}));
}

TEST(DetailChoice, WhoeverBecomesImportantTakesThePlaceOfAnother) {
  Crowd crowd({1, 2, 3});
  crowd.run(2.6f, 3.0f);
  ASSERT_EQ(crowd.given_up(), (Steps{3, 0, 0}));
  crowd.candidates[0].importance = 2.4f;  // not clearly more than 2
  crowd.run(2.6f, 2.3f);
  EXPECT_EQ(crowd.given_up(), (Steps{3, 0, 0}));
  crowd.candidates[0].importance = 2.6f;
  crowd.run(2.6f, 2.3f);
  EXPECT_EQ(crowd.given_up(), (Steps{0, 3, 0}));
}

TEST(DetailChoice, PropertyMeasuredTimesThatWaverSettle) {
  // What a tick takes differs from the model by a third and from tick to tick by a tenth.
  std::mt19937 random(7);
  std::uniform_real_distribution<float> noise(0.9f, 1.1f), importance(0.0f, 10.0f);
  for (const float budget : {0.5f, 1.0f, 2.0f, 4.0f}) {
    std::vector<float> values(40);
    for (float& value : values) value = importance(random);
    Crowd crowd(values);
    const auto milliseconds = [&] {
      float sum = 1.0f;  // that no cloth can save
      for (const DetailCandidate& c : crowd.candidates) sum += 1e-3f * c.work[std::min(c.given_up, 2u)];
      return sum;
    };
    float pace = milliseconds() / crowd.work();
    int changes = 0;
    for (int tick = 0; tick < 600; ++tick) {
      const Steps before = crowd.given_up();
      pace += 0.2f * (milliseconds() * noise(random) / crowd.work() - pace);
      crowd.job(budget, pace).run();
      if (tick >= 300 && crowd.given_up() != before) ++changes;
    }
    EXPECT_LE(changes, 3) << budget;
    EXPECT_TRUE(milliseconds() <= 1.05f * budget || crowd.given_up() == Steps(40, 3)) << budget;
    EXPECT_TRUE(milliseconds() >= 0.7f * budget || crowd.given_up() == Steps(40, 0)) << budget;
  }
}

TEST(DetailWork, FallsStepByStepAndStopsAtOneSubstep) {
  const auto work = detail_work(66, 12, 176, 1000, true);
  EXPECT_GT(work[0], work[1]);
  EXPECT_FLOAT_EQ(work[1] - work[2], 66.0f * 6.0f);
  EXPECT_FLOAT_EQ(work[2] - work[3], 66.0f * 2.0f);
  const auto one = detail_work(66, 1, 0, 0, true);
  EXPECT_EQ(one[0], one[3]);
  const auto fixed = detail_work(66, 16, 176, 1000, false);
  EXPECT_EQ(fixed[1], fixed[3]);
}

}  // namespace
}  // namespace pleat
