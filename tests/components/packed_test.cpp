#include "components/packed.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pleat {
namespace {

TEST(UnormBox, PlacesAreWithinHalfAStep) {
  for (const float away : {0.0f, 1.0f, 1000.0f}) {
    const Vec3 low{away - 0.3f, -away, 0.25f * away}, high = low + Vec3{1.7f, 0.004f, 60.0f};
    const UnormBox box(low, high);
    for (int i = 0; i <= 10000; ++i) {
      const float t = static_cast<float>(i) / 10000.0f;
      const Vec3 p{std::lerp(low.x, high.x, t), std::lerp(low.y, high.y, t * t), std::lerp(low.z, high.z, 1.0f - t)};
      const auto u = box.pack(p);
      const auto expect_near = [](float value, float from, float to, std::uint16_t packed) {
        const double step = (double(to) - double(from)) / 65535.0;
        EXPECT_LE(std::abs(double(from) + packed * step - double(value)), 0.51 * step + 1e-9);
      };
      expect_near(p.x, low.x, high.x, u[0]);
      expect_near(p.y, low.y, high.y, u[1]);
      expect_near(p.z, low.z, high.z, u[2]);
    }
    EXPECT_EQ(box.pack(low), (std::array<std::uint16_t, 3>{0, 0, 0}));
    EXPECT_EQ(box.pack(high), (std::array<std::uint16_t, 3>{65535, 65535, 65535}));
  }
}

TEST(UnormBox, OfAFlatClothHasOneHeight) {
  for (const float thickness : {0.0f, 1e-45f, 1e-30f}) {
    const UnormBox box({-1.0f, 0.0f, -1.0f}, {1.0f, thickness, 1.0f});
    EXPECT_EQ(box.pack({0.0f, thickness, 1.0f}), (std::array<std::uint16_t, 3>{32768, 0, 65535})) << thickness;
  }
}

TEST(Snorm16, NumbersAreWithinHalfAStep) {
  for (int i = -100000; i <= 100000; ++i) {
    const float v = static_cast<float>(i) / 100000.0f;
    EXPECT_LE(std::abs(snorm16(v) / 32767.0 - double(v)), 0.51 / 32767.0) << v;
    EXPECT_EQ(snorm16(-v), -snorm16(v));
  }
  EXPECT_EQ(snorm16(1.0f), 32767);
  EXPECT_EQ(snorm16(std::nextafter(1.0f, 2.0f)), 32767);  // normalised, and rounded up
  EXPECT_EQ(snorm16(-0.0f), 0);
}

TEST(Snorm16, DirectionsTurnByNoMoreThanStated) {
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {  // a spiral over the sphere
    const double z = (i + 0.5) / 10000.0 - 1.0, r = std::sqrt(1.0 - z * z), a = 2.399963 * i;
    const Vec3 n{static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), static_cast<float>(z)};
    const Vec3T<double> exact{double(n.x), double(n.y), double(n.z)},
        packed{double(snorm16(n.x)), double(snorm16(n.y)), double(snorm16(n.z))};
    worst = std::max(worst, std::atan2(length(cross(exact, packed)), dot(exact, packed)));
  }
  EXPECT_LE(worst, 1.01 * std::numbers::sqrt3 / 65534.0);
  EXPECT_GT(worst, 0.8 * std::numbers::sqrt3 / 65534.0) << "the bound is not tight";
}

}  // namespace
}  // namespace pleat
