// The same cloth at any frame rate: it hangs, swings and flutters alike.
#include <algorithm>
#include <cmath>

#include "tests/engine/scene.h"

namespace pleat {
namespace {

constexpr std::uint32_t kSide = 7;
constexpr int kRates[] = {24, 30, 60, 120, 144};  // and 240 Hz, to compare with

/// A sheet of 1 m that starts level, held at two corners, or at its whole edge.
struct Hanging : Scene {
  pleat_cloth id;

  explicit Hanging(const pleat_cloth_settings& s) : id(cloth(sheet(kSide), s)) {}
  std::vector<float> after(double seconds, int rate) {
    step(static_cast<int>(std::lround(seconds * rate)), 1.0f / static_cast<float>(rate));
    return particles(id);
  }
};

/// Root mean square over all particles, m.
float distance(const std::vector<float>& a, const std::vector<float>& b) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < 3 * kSide * kSide; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / (kSide * kSide));
}

float mean_height(const std::vector<float>& state) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < kSide * kSide; ++i) sum += state[3 * i + 1];
  return sum / (kSide * kSide);
}

TEST(FrameRate, ADrapeEndsInTheSameShape) {
  pleat_cloth_settings s = Scene::default_settings();
  s.air_damping = 2.0f;
  const std::vector<float> fine = Hanging(s).after(4.0, 240);
  for (const int rate : kRates) {
    const std::vector<float> end = Hanging(s).after(4.0, rate);
    EXPECT_LT(distance(end, fine), 0.01f) << rate << " Hz";
  }
}

/// From level: the lower edge swings through and back; the period of the centre of mass about the pins.
TEST(FrameRate, ASwingTakesTheSameTime) {
  const auto period = [](int rate) {
    pleat_cloth_settings s = Scene::default_settings();
    Hanging scene(s);
    std::vector<double> crossings;  // of the plane below the pins, at z = -0.5
    double before = 1.0;
    for (int i = 1; i <= 6 * rate && crossings.size() < 5; ++i) {
      scene.step(1, 1.0f / static_cast<float>(rate));
      const std::vector<float> x = scene.particles(scene.id);
      double z = 0.5;
      for (std::size_t k = 0; k < kSide * kSide; ++k) z += double(x[3 * k + 2]) / (kSide * kSide);
      if (z * before < 0.0) crossings.push_back((i - z / (z - before)) / rate);
      before = z;
    }
    return crossings.size() < 5 ? 0.0 : crossings[4] - crossings[0];
  };
  const double fine = period(240);
  ASSERT_GT(fine, 1.0);
  for (const int rate : kRates) EXPECT_NEAR(period(rate) / fine, 1.0, 0.02) << rate << " Hz";
}

TEST(FrameRate, AGustBlowsTheSameWay) {
  const auto blown = [](int rate) {
    pleat_cloth_settings s = Scene::default_settings();
    s.drag_coefficient = 1.0f;
    s.air_damping = 1.0f;
    Hanging scene(s);
    const float wind[3] = {0, 0, 3};
    must(call::world_set_wind(scene, wind));
    must(call::world_set_gust(scene, 1.0f, 1.0f, 5));
    return scene.after(3.0, rate);
  };
  const std::vector<float> fine = blown(240);
  EXPECT_GT(mean_height(fine), -0.5f);
  for (const int rate : kRates) EXPECT_LT(distance(blown(rate), fine), 0.01f) << rate << " Hz";
}

}  // namespace
}  // namespace pleat
