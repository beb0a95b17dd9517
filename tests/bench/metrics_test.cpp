// Each metric on shapes whose answer is known without it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "bench/fine_square.h"
#include "bench/metrics/area_samples.h"
#include "bench/metrics/silhouette.h"
#include "bench/metrics/size_error.h"
#include "bench/metrics/surface_distance.h"
#include "bench/metrics/wrinkle_spectrum.h"
#include "demo/scenes/icosphere.h"

namespace pleat::bench {
namespace {

using demo::TriangleMesh;
constexpr double kPi = std::numbers::pi;

/// 1 m a side, level, around the origin.
TriangleMesh square(uint32_t n) { return flat_square(*pleat_get_api(PLEAT_API_MAJOR), n); }

/// Every point goes to where `move` of it is.
template <class F>
TriangleMesh moved(TriangleMesh mesh, F move) {
  for (size_t i = 0; i < mesh.positions.size(); i += 3) {
    float* p = &mesh.positions[i];
    const demo::Vector3d to = move(demo::Vector3d(p[0], p[1], p[2]));
    for (int axis = 0; axis < 3; ++axis) p[axis] = float(to[axis]);
  }
  return mesh;
}

TriangleMesh sphere(double radius) { return demo::make_icosphere(5, Eigen::Vector3d::Zero(), radius); }

TEST(AreaSamples, FollowTheArea) {
  const TriangleMesh stretched = moved(square(5), [](const demo::Vector3d& p) {
    return demo::Vector3d(p.x() < 0.0 ? p.x() : 3.0 * p.x(), 0.0, p.z());
  });  // .5 m2 to the left, 1.5 m2 to the right
  size_t right = 0;
  demo::Vector3d sum = demo::Vector3d::Zero();
  for (const AreaSample& sample : area_samples(stretched, 4000, 7)) {
    right += sample.point.x() > 0.0;
    sum += sample.point;
    EXPECT_NEAR(std::abs(sample.normal.y()), 1.0, 1e-9);
  }
  EXPECT_NEAR(double(right), 3000.0, 2.0);
  EXPECT_NEAR(sum.x() / 4000, 0.25 * -0.25 + 0.75 * 0.75, 0.005);
  EXPECT_NEAR(sum.z() / 4000, 0.0, 0.005);
}

TEST(AreaSamples, AreTheSameForASeed) {
  const TriangleMesh sheet = square(5);
  const auto sum = [&](uint32_t seed) {
    double x = 0.0;
    for (const AreaSample& sample : area_samples(sheet, 100, seed)) x += sample.point.x();
    return x;
  };
  EXPECT_EQ(sum(3), sum(3));
  EXPECT_NE(sum(3), sum(4));
}

TEST(SurfaceDistance, OfASurfaceFromItselfIsZero) {
  const TriangleMesh ball = sphere(0.5);
  const SurfaceDistance same = surface_distance(ball, ball);
  EXPECT_LT(same.hausdorff, 1e-7);
  EXPECT_LT(same.normal_rms_deg, 1e-3);
}

TEST(SurfaceDistance, OfALiftedPlaneIsTheLift) {
  const TriangleMesh plane = square(9);
  const TriangleMesh lifted =
      moved(square(6), [](const demo::Vector3d& p) { return demo::Vector3d(p.x(), p.y() + 0.02, p.z()); });
  const SurfaceDistance apart = surface_distance(plane, lifted);
  EXPECT_NEAR(apart.rms, 0.02, 1e-6);
  EXPECT_NEAR(apart.hausdorff, 0.02, 1e-6);
  EXPECT_NEAR(apart.normal_rms_deg, 0.0, 1e-3);
}

TEST(SurfaceDistance, SeesWhatOnlyOneOfThemHas) {
  // A plane and its left half: of the first, the right half is 0 to .5 m away, .5 / sqrt(3) on the mean square.
  const TriangleMesh whole = square(9);
  const TriangleMesh half =
      moved(whole, [](const demo::Vector3d& p) { return demo::Vector3d(0.5 * (p.x() - 0.5), p.y(), p.z()); });
  const double expected = std::sqrt(0.5 * 0.5 * 0.25 / 3.0);  // half of all samples, half of those
  EXPECT_NEAR(surface_distance(whole, half).rms, expected, 0.002);
  EXPECT_NEAR(surface_distance(half, whole).rms, expected, 0.002);
  EXPECT_NEAR(surface_distance(half, whole).hausdorff, 0.5, 0.005);
}

TEST(SurfaceDistance, OfSpheresIsTheDifferenceOfRadii) {
  const SurfaceDistance apart = surface_distance(sphere(0.5), sphere(0.53));
  EXPECT_NEAR(apart.rms, 0.03, 2e-4);
  EXPECT_NEAR(apart.hausdorff, 0.03, 6e-4);
}

TEST(SurfaceDistance, NormalsOfATurnedPlaneDifferByItsTurn) {
  const double turn = 10.0 * kPi / 180.0;
  const TriangleMesh turned = moved(square(9), [=](const demo::Vector3d& p) {
    return demo::Vector3d(p.x() * std::cos(turn), p.x() * std::sin(turn), p.z());
  });
  EXPECT_NEAR(surface_distance(square(9), turned).normal_rms_deg, 10.0, 1e-3);
}

TEST(SizeError, OfASquareAndItsDouble) {
  const TriangleMesh sheet = square(5);
  EXPECT_NEAR(mesh_area(sheet.positions, sheet.triangles), 1.0, 1e-6);
  const TriangleMesh larger = moved(sheet, [](const demo::Vector3d& p) { return demo::Vector3d(2.0 * p); });
  EXPECT_NEAR(mesh_area(larger.positions, larger.triangles), 4.0, 1e-5);
}

TEST(SizeError, LengthsLongerAndShorter) {
  const float points[] = {0, 0, 0, 1, 0, 0, 1, 0, 2};
  const uint32_t edges[] = {0, 1, 1, 2, 0, 2};
  const float rest[] = {1.0f, 2.5f, std::sqrt(5.0f) / 1.01f};  // exact, 20 % short, 1 % long
  const LengthError error = length_error(points, edges, rest);
  EXPECT_NEAR(error.median_percent, 1.0, 1e-4);
  EXPECT_NEAR(error.p99_percent, 20.0, 1e-4);
}

TEST(Silhouette, OfASphereIsADisc) {
  const SilhouetteView view{demo::Vector3d::UnitX(), demo::Vector3d::UnitY(), demo::Vector3d(0.1, 0.0, 0.0), 2.0};
  const Silhouette disc = draw_silhouette(sphere(0.5), view, 400);
  const auto covered = double(std::accumulate(disc.covered.begin(), disc.covered.end(), size_t{0}));
  EXPECT_NEAR(covered * 4.0 / (400.0 * 400.0), kPi * 0.25, 0.003);
  EXPECT_TRUE(disc.covered[200 * 400 + 181]);  // its centre is 20 pixels to the left of the picture's
  EXPECT_FALSE(disc.covered[200 * 400 + 285]);
  EXPECT_TRUE(disc.covered[200 * 400 + 85]);
}

TEST(Silhouette, OverlapOfSpheresIsTheRatioOfDiscs) {
  EXPECT_EQ(silhouette_overlap(sphere(0.5), sphere(0.5), 256), 1.0);
  EXPECT_NEAR(silhouette_overlap(sphere(0.5), sphere(0.4), 512), 0.64, 0.005);
  const TriangleMesh far =
      moved(sphere(0.5), [](const demo::Vector3d& p) { return demo::Vector3d(p.x(), p.y() + 3.0, p.z()); });
  EXPECT_EQ(silhouette_overlap(sphere(0.5), far, 256), 0.0);
}

/// y = a sin(2 pi waves u) for u = 0..1 along a line.
std::vector<float> wave(double a, double waves, size_t count) {
  std::vector<float> points;
  for (size_t i = 0; i < count; ++i) {
    const double u = double(i) / double(count - 1);
    points.insert(points.end(), {float(2.0 * u), float(a * std::sin(2.0 * kPi * waves * u)), float(-u)});
  }
  return points;
}

TEST(WrinkleSpectrum, AWaveIsInItsBand) {
  const double energy = 0.5 * 0.02 * 0.02;
  EXPECT_NEAR(line_spectrum(wave(0.02, 1.0, 65))[0], energy, 1e-4 * energy);   // wavelength 1
  EXPECT_NEAR(line_spectrum(wave(0.02, 3.0, 65))[1], energy, 1e-4 * energy);   // 1/3
  EXPECT_NEAR(line_spectrum(wave(0.02, 5.0, 65))[2], energy, 1e-4 * energy);   // .2
  EXPECT_NEAR(line_spectrum(wave(0.02, 10.0, 65))[3], energy, 1e-4 * energy);  // .1
  EXPECT_NEAR(line_spectrum(wave(0.02, 20.0, 65))[4], energy, 1e-4 * energy);  // .05
  EXPECT_NEAR(line_spectrum(wave(0.02, 31.0, 65))[5], energy, 1e-4 * energy);  // .032
}

TEST(WrinkleSpectrum, SumsToTheMeanSquareOfAnyLine) {
  std::vector<float> line;
  double mean_square = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double y = 0.03 * std::sin(0.7 * i) * i * (100 - i) / 2500.0;
    line.insert(line.end(), {0.0f, float(y), float(0.5 * i)});
    mean_square += y * y / 100.0;
  }
  const WrinkleSpectrum spectrum = line_spectrum(line);
  EXPECT_NEAR(std::accumulate(spectrum.begin(), spectrum.end(), 0.0), mean_square, 1e-5 * mean_square);
}

TEST(WrinkleSpectrum, AStraightLineHasNone) {
  const float points[] = {0, 0, 0, 1, 2, 3, 2, 4, 6, 3, 6, 9};
  for (const double energy : line_spectrum(points)) EXPECT_NEAR(energy, 0.0, 1e-12);
}

TEST(WrinkleSpectrum, OfASheetIsTheMeanOfBothWays) {
  std::vector<float> points;
  for (int row = 0; row < 64; ++row) {
    const std::vector<float> line = wave(0.02, 5.0, 64);
    points.insert(points.end(), line.begin(), line.end());
  }
  // Rows wave, columns are points upon points: no waves.
  EXPECT_NEAR(sheet_spectrum(points, 64, 64)[2], 0.25 * 0.02 * 0.02, 1e-4 * 0.25 * 0.02 * 0.02);
}

}  // namespace
}  // namespace pleat::bench
