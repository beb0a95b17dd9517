#include "systems/gust.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pleat {
namespace {

constexpr Vec3 kWind{3, 0, 1};

Vec3 air_at(double time, std::uint32_t seed = 1, float strength = 2.0f, float frequency = 2.0f) {
  Vec3 air;
  const Gust gust{.wind = kWind, .strength = strength, .frequency = frequency, .seed = seed, .time = time, .air = &air};
  EXPECT_TRUE(gust.validate());
  gust.run();
  return air;
}

TEST(Gust, RefusesToRunWithAFieldMissing) {
  Vec3 air;
  const Gust good{.wind = kWind, .strength = 1.0f, .frequency = 1.0f, .air = &air};
  ASSERT_TRUE(good.validate());
  Gust bad = good;
  bad.air = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.strength = -1.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.frequency = 0.0f;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.wind.y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(bad.validate());
}

TEST(Gust, HasTheMeanTheStrengthAndTheBoundThatItSays) {
  constexpr int kCount = 100000;
  double mean[3] = {}, square[3] = {};
  float most = 0.0f;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 d = air_at(0.0371 * i) - kWind;
    const float parts[] = {d.x, d.y, d.z};
    for (int k = 0; k < 3; ++k) {
      mean[k] += static_cast<double>(parts[k]) / kCount;
      square[k] += static_cast<double>(parts[k]) * static_cast<double>(parts[k]) / kCount;
      most = std::max(most, std::abs(parts[k]));
    }
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[k], 0.0, 0.05);
    EXPECT_NEAR(std::sqrt(square[k]), 2.0, 0.06);
  }
  EXPECT_LT(most, 2.51f * 2.0f);
  EXPECT_GT(most, 1.8f * 2.0f);
}

TEST(Gust, IsSmoothAndHasNoFastParts) {
  for (int i = 0; i < 1000; ++i) {  // across the knots at multiples of 1/4 s too
    const double t = 0.25 * i, h = 1e-3;
    const float before = air_at(t - h + 1.0).x, now = air_at(t + 1.0).x, after = air_at(t + h + 1.0).x;
    EXPECT_LT(std::abs(after - 2.0f * now + before), 2.0f * 2.51f * 16.0f * 4e-6f + 4e-6f);
  }
  // Amplitude at 3 times the band limit: below a hundredth of that at a fifth of it.
  const auto amplitude = [](double hertz) {
    double c = 0.0, s = 0.0;
    constexpr int kCount = 40000;
    for (int i = 0; i < kCount; ++i) {
      const double t = 0.01 * i, phase = 2.0 * std::numbers::pi * hertz * t;
      const double window = 1.0 - std::cos(2.0 * std::numbers::pi * i / kCount), x = air_at(t).y;
      c += window * x * std::cos(phase), s += window * x * std::sin(phase);
    }
    return std::hypot(c, s);
  };
  double low = 0.0, high = 0.0;
  for (int i = 0; i < 8; ++i) low += amplitude(0.4 + 0.01 * i), high += amplitude(6.0 + 0.01 * i);
  EXPECT_LT(high, 0.01 * low);
}

TEST(Gust, SameSeedSameGustsOtherSeedOthers) {
  double apart = 0.0;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(air_at(0.1 * i, 5), air_at(0.1 * i, 5));
    apart = std::max(apart, static_cast<double>(length(air_at(0.1 * i, 5) - air_at(0.1 * i, 6))));
  }
  EXPECT_GT(apart, 1.0);
  EXPECT_EQ(air_at(3.3, 5, 0.0f), kWind);
}

}  // namespace
}  // namespace pleat
