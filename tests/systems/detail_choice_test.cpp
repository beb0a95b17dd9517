#include "systems/detail_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace pleat {
namespace {

constexpr OfSteps kWork = {100, 90, 60, 50, 30, 20, 12, 8};

struct Crowd {
  std::vector<DetailCandidate> candidates;
  float scarcity = 0.0f;

  explicit Crowd(const std::vector<float>& importance) {
    for (const float value : importance) candidates.push_back({.importance = value, .work = kWork});
  }
  DetailChoice job(float budget, float pace) {
    return {.candidates = candidates, .budget = budget, .pace = pace, .scarcity = scarcity};
  }
  /// A unit of work takes a millisecond.
  void keep(float budget) { scarcity = job(budget, 1.0f).run(); }
  float work() const {
    float sum = 0.0f;
    for (const DetailCandidate& c : candidates) sum += c.work[c.given_up];
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
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  Crowd crowd({1, 2});
  const DetailChoice good = crowd.job(1.0f, 2.0f);
  EXPECT_TRUE(good.validate());
  for (float DetailChoice::*field : {&DetailChoice::budget, &DetailChoice::pace, &DetailChoice::scarcity}) {
    for (const float value : {-1.0f, kNotANumber}) {
      DetailChoice bad = good;
      bad.*field = value;
      EXPECT_FALSE(bad.validate());
    }
  }
  DetailChoice bad = good;
  bad.budget = 0.0f;
  EXPECT_FALSE(bad.validate());
  crowd.candidates[1].importance = kNotANumber;
  EXPECT_FALSE(good.validate());
  crowd.candidates[1] = {.given_up = kMostGivenUp + 1};
  EXPECT_FALSE(good.validate());
}

TEST(DetailChoice, WithinTheBudgetAllKeepTheirDetail) {
  Crowd crowd({1, 2, 0});
  crowd.keep(300.0f);
  EXPECT_EQ(crowd.given_up(), (Steps{0, 0, 0}));
  EXPECT_EQ(crowd.scarcity, 0.0f);
}

TEST(DetailChoice, WhoMattersLeastGivesUpFirstAndNoMoreThanIsNeeded) {
  Crowd crowd({100, 1, 99});
  crowd.keep(270.0f);  // 256 is wanted: the second gives up half of its substeps, too
  EXPECT_EQ(crowd.given_up(), (Steps{0, 3, 0}));
  crowd.keep(215.0f);  // 204 is more than the second can save
  EXPECT_EQ(crowd.given_up()[1], kMostGivenUp);
  EXPECT_EQ(crowd.given_up()[0] + crowd.given_up()[2], 1u);
}

TEST(DetailChoice, OneThatCountsTwiceAsMuchGivesUpLess) {
  Crowd crowd({1, 2});
  for (float budget = 195.0f; budget > 20.0f; budget -= 5.0f) {
    crowd.keep(budget);
    EXPECT_GE(crowd.given_up()[0], crowd.given_up()[1]) << budget;
    EXPECT_LE(crowd.given_up()[0], crowd.given_up()[1] + 3) << budget;
  }
}

TEST(DetailChoice, AmongEqualsTheFirstGiveUpFirst) {
  Crowd crowd({1, 1, 1, 1});
  crowd.keep(390.0f);
  EXPECT_EQ(crowd.given_up(), (Steps{1, 1, 1, 0}));
}

TEST(DetailChoice, WhatCannotBeKeptIsKeptAsNearlyAsPossible) {
  Crowd crowd({1, 0, 1e30f});
  crowd.keep(0.1f);
  EXPECT_EQ(crowd.given_up(), Steps(3, kMostGivenUp));
}

TEST(DetailChoice, WhereNothingMattersAllMatterAlike) {
  Crowd crowd({0, 0, 0, 0});
  crowd.keep(390.0f);
  EXPECT_EQ(crowd.given_up(), (Steps{1, 1, 1, 0}));
}

TEST(DetailChoice, DetailComesBack) {
  Crowd crowd({3, 1, 0});
  crowd.keep(60.0f);
  const Steps scarce = crowd.given_up();
  crowd.keep(250.0f);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(crowd.given_up()[i], scarce[i]);
  EXPECT_GE(crowd.work(), 0.75f * 250.0f);
  EXPECT_LE(crowd.work(), 0.9f * 250.0f);
  crowd.keep(1000.0f);
  EXPECT_EQ(crowd.given_up(), (Steps{0, 0, 0}));
}

TEST(DetailChoice, ACalmBudgetChangesNothingUntilImportanceDoesClearly) {
  Crowd crowd({1, 10});
  crowd.keep(175.0f);
  const Steps before = crowd.given_up();
  ASSERT_GT(before[0], before[1]);
  crowd.candidates[0].importance = 1.05f, crowd.candidates[1].importance = 9.5f;
  crowd.keep(175.0f);
  EXPECT_EQ(crowd.given_up(), before);
  std::swap(crowd.candidates[0].importance, crowd.candidates[1].importance);
  for (int tick = 0; tick < 3; ++tick) crowd.keep(175.0f);
  EXPECT_EQ(crowd.given_up()[0], before[1]);
  EXPECT_GE(crowd.given_up()[1], before[0] - 1);
}

TEST(DetailChoice, PropertyTheBudgetIsKeptWithNoMoreThanThat) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> decades(-3.0f, 3.0f), shares(0.1f, 0.95f);
  for (int crowd_number = 0; crowd_number < 200; ++crowd_number) {
    std::vector<float> values(100);
    for (float& value : values) value = std::pow(10.0f, decades(random));
    Crowd crowd(values);
    const float budget = shares(random) * crowd.work();
    crowd.keep(budget);
    EXPECT_LE(crowd.work(), 0.95f * budget);
    EXPECT_GE(crowd.work(), 0.95f * budget - 30.0f) << "one step of one cloth";
    for (const DetailCandidate& c : crowd.candidates) {
      EXPECT_LE(0.8f * kLoss[c.given_up] * c.importance, crowd.scarcity);
      const std::uint32_t next = std::min(c.given_up + 1, kMostGivenUp);
      EXPECT_TRUE(next == c.given_up || kLoss[next] * c.importance > crowd.scarcity);
    }
  }
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
      float sum = 0.3f;  // that no cloth can save
      for (const DetailCandidate& c : crowd.candidates) sum += 1e-3f * c.work[std::min(c.given_up, 6u)];
      return sum;
    };
    float pace = milliseconds() / crowd.work();
    int changes = 0;
    for (int tick = 0; tick < 600; ++tick) {
      const Steps before = crowd.given_up();
      pace += 0.2f * (milliseconds() * noise(random) / crowd.work() - pace);
      crowd.scarcity = crowd.job(budget, pace).run();
      if (tick >= 300 && crowd.given_up() != before) ++changes;
    }
    EXPECT_LE(changes, 3) << budget;
    EXPECT_TRUE(milliseconds() <= 1.05f * budget || crowd.given_up() == Steps(40, kMostGivenUp)) << budget;
    EXPECT_TRUE(milliseconds() >= 0.7f * budget || crowd.given_up() == Steps(40, 0)) << budget;
  }
}

TEST(ClothWork, FallsStepByStep) {
  const ClothWork cloth{.particles = 66, .substeps = 12, .folds = 176, .drawn = 1000};
  const OfSteps work = cloth.by_steps(true, true);
  EXPECT_TRUE(std::ranges::is_sorted(work, std::greater()));
  EXPECT_FLOAT_EQ(work[0], cloth.of_tick());
  EXPECT_FLOAT_EQ(work[1] - work[2], 66.0f * 6.0f);
  EXPECT_FLOAT_EQ(work[2] - work[3], 66.0f * 2.0f);
  EXPECT_FLOAT_EQ(work[5], 0.5f * (work[4] + cloth.of_carrying()));
}

TEST(ClothWork, WhatCannotBeGivenUpStays) {
  const ClothWork one{.particles = 66, .substeps = 1, .drawn = 0};
  EXPECT_EQ(one.by_steps(true, false)[0], one.by_steps(true, false)[kMostGivenUp]);
  const ClothWork many{.particles = 66, .substeps = 16, .folds = 176, .drawn = 1000};
  EXPECT_EQ(many.by_steps(false, false)[1], many.by_steps(false, false)[kMostGivenUp]);
  EXPECT_GT(many.by_steps(false, false)[0], many.by_steps(false, false)[1]);
  EXPECT_EQ(ClothWork{}.by_steps(true, true), OfSteps{});
}

}  // namespace
}  // namespace pleat
