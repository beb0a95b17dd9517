// What error_vs_time stands on: fronts, scenes, references.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/bullet_scene.h"
#include "bench/error/contest.h"
#include "bench/error/log_chart.h"
#include "bench/error/meshes.h"
#include "bench/error/pareto.h"
#include "bench/error/reference.h"
#include "bench/fine_square.h"
#include "demo/input_error.h"

namespace pleat::bench {
namespace {

const pleat_api& api() { return *pleat_get_api(PLEAT_API_MAJOR); }

const RestScene& scene_named(std::string_view name) {
  return *std::ranges::find(rest_scenes(), name, &RestScene::name);
}

TEST(Pareto, FrontOfSomePoints) {
  const TimeAndError points[] = {{4, 1}, {1, 8}, {2, 9}, {2, 4}, {3, 4}, {1, 10}};
  EXPECT_EQ(pareto_front(points), (std::vector<size_t>{1, 3, 0}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Pareto, TimeToAnError) {
  const TimeAndError points[] = {{1, 100}, {100, 1}, {50, 60}};  // the last one helps nobody on the way to 10
  EXPECT_NEAR(*time_to_error(points, 100.0), 1.0, 1e-12);
  EXPECT_NEAR(*time_to_error(points, 500.0), 1.0, 1e-12);
  EXPECT_NEAR(*time_to_error(points, 1.0), 100.0, 1e-9);
  EXPECT_FALSE(time_to_error(points, 0.5));
  const TimeAndError line[] = {{1, 100}, {100, 1}};
  EXPECT_NEAR(*time_to_error(line, 10.0), 10.0, 1e-9);
}

TEST(LogChart, HoldsEveryPointAndWord) {
  const Panel panels[] = {{"first scene", {{"ours", {{0.1, 0.01}, {1.0, 0.001}}}, {"theirs", {{2.0, 0.02}}}}}};
  const std::string svg = log_charts("title", "ms", "m", panels);
  const auto count = [&](const std::string& word) {
    size_t n = 0;
    for (size_t at = svg.find(word); at != std::string::npos; at = svg.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("r=\"6\""), 3u);  // rings: both of ours, and one in the legend
  EXPECT_EQ(count(">ours<"), 1u);
  EXPECT_EQ(count(">theirs<"), 1u);
  EXPECT_EQ(count("first scene"), 1u);
  EXPECT_EQ(count(">0.01<"), 1u);  // a tick
  EXPECT_EQ(count("nan"), 0u);
}

TEST(RestScene, HasAboutAsManyParticlesAsItSays) {
  const double wanted[] = {33, 66, 264, 1056};
  for (const RestScene& scene : rest_scenes()) {
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(scene.coarse[i].particles() / wanted[i], 1.0, 0.1) << scene.name;
    for (const Grid& grid : scene.coarse) {
      const demo::SceneDef def = rest_scene_def(api(), scene, grid, rest_settings(api(), scene), 60.0);
      EXPECT_FALSE(def.pins.empty()) << scene.name;
      EXPECT_EQ(start_positions(scene, grid).size(), def.garment.positions.size());
    }
  }
}

/// Every pattern covers the rectangle once, all faces the same side up.
TEST(RestScene, PatternsAreSheets) {
  const RestScene& scene = scene_named("bowl");
  for (const Pattern pattern : {Pattern::kAlternating, Pattern::kOneWay, Pattern::kStaggered}) {
    for (const uint32_t rows : {2u, 5u, 6u}) {
      const Grid grid{rows, 7, pattern};
      const demo::SceneDef def = rest_scene_def(api(), scene, grid, rest_settings(api(), scene), 60.0);
      const std::vector<float>& x = def.garment.positions;
      ASSERT_EQ(x.size(), size_t{3} * grid.particles());
      EXPECT_EQ(start_positions(scene, grid).size(), x.size());
      EXPECT_EQ(def.pins.size(), 4u);
      double area = 0.0;
      const std::vector<uint32_t>& corner = def.garment.triangles;
      for (size_t t = 0; t < corner.size(); t += 3) {
        const auto way = [&](size_t k, size_t axis) {
          return double(x[3 * corner[t + k] + axis]) - double(x[3 * corner[t] + axis]);
        };
        const double twice = way(1, 2) * way(2, 0) - way(1, 0) * way(2, 2);
        EXPECT_GT(twice, 1e-3) << t / 3;
        area += 0.5 * twice;
      }
      EXPECT_NEAR(area, 1.0, 1e-5) << size_t(pattern) << ", " << rows;
    }
  }
}

TEST(RestScene, ResamplingIsExactWhereItIsLinear) {
  const RestScene& scene = rest_scenes()[0];
  const demo::SceneDef coarse = rest_scene_def(api(), scene, {4, 7}, rest_settings(api(), scene), 60.0);
  const demo::SceneDef fine = rest_scene_def(api(), scene, {10, 16}, rest_settings(api(), scene), 60.0);
  const std::vector<float> samples = resampled(coarse.garment.positions, {4, 7}, {10, 16});
  ASSERT_EQ(samples.size(), fine.garment.positions.size());
  for (size_t i = 0; i < samples.size(); ++i) EXPECT_NEAR(samples[i], fine.garment.positions[i], 1e-6);
}

TEST(Reference, DependsLittleOnItsMesh) {
  for (const RestScene& scene : rest_scenes()) {
    const Reference reference = read_reference(PLEAT_FINE_DIR, scene);
    const SurfaceDistance halving =
        surface_distance(reference_surface(api(), reference.fine), reference_surface(api(), reference.half), 4000);
    EXPECT_LT(halving.rms, 1e-3) << scene.name;
  }
}

/// The catenary of length 1 over a span of .8 m: y = a cosh(x / a), 2 a sinh(span / (2 a)) = 1.
TEST(Reference, TheCatenaryIsOne) {
  double low = 0.1, high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(0.4 / a) > 1.0 ? low : high) = a;
  }
  const std::vector<float> points = read_reference(PLEAT_FINE_DIR, scene_named("catenary")).fine;
  for (uint32_t column = 0; column < kFineSide; ++column) {
    const float* p = &points[3 * (size_t{kFineSide} * (kFineSide / 2) + column)];  // on the middle line
    const double expected = low * (std::cosh(double(p[0]) / low) - std::cosh(0.4 / low));
    EXPECT_NEAR(p[1], expected, 2e-3) << column;
  }
}

/// Each half of the strip is a cantilever.
TEST(Reference, TheStripIsAnElastica) {
  const RestScene& scene = scene_named("strip");
  const double gamma = double(rest_settings(api(), scene).density) * 9.81 * 0.125 / double(scene.bend_stiffness);
  ASSERT_NEAR(gamma, 245.25, 1e-3);
  constexpr double kDroop = 9.982;  // of the elastica of that gamma, by shooting with Runge-Kutta steps of 1/4000
  const std::vector<float> points = read_reference(PLEAT_FINE_DIR, scene).fine;
  const float* tip = &points[3 * (size_t{kFineSide} * (kFineSide / 2) + kFineSide - 1)];
  const double droop = -double(tip[1]) / double(tip[0]);
  EXPECT_NEAR(droop / kDroop, 1.0, 0.015);
}

TEST(Contest, EveryDynamicsComesNearTheTruth) {
  const RestScene& scene = scene_named("catenary");
  std::vector<Contestants> few = contestants(api(), scene, rest_settings(api(), scene), true);
  std::erase_if(few, [](const Contestants& c) { return c.dynamics.grid.particles() > 70; });
  size_t steps = 0;
  const std::vector<Score> scores =
      hold_contest(api(), scene, read_reference(PLEAT_FINE_DIR, scene), few, true, [&] { ++steps; });
  EXPECT_EQ(steps, few.size());
  for (const Score& score : scores) {
    EXPECT_GT(score.ms, 0.0);
    EXPECT_LT(score.error.rms, 0.03) << score.method << ", " << score.dynamics;
    EXPECT_GT(score.error.rms, 1e-5) << score.method << ", " << score.dynamics;
    EXPECT_LT(score.edges.median_percent, 5.0) << score.method << ", " << score.dynamics;
    EXPECT_GT(score.wrinkles[0], 0.005) << score.method << ", " << score.dynamics;  // m2: the sag of .27 m
  }
}

TEST(Meshes, EachComesNearTheTruthAndIsDrawn) {
  RestScene scene = scene_named("catenary");
  scene.coarse.fill({3, 11});
  size_t steps = 0;
  const std::vector<MeshScores> scores =
      score_meshes(api(), scene, rest_settings(api(), scene), read_reference(PLEAT_FINE_DIR, scene), [&] { ++steps; });
  EXPECT_EQ(steps, kPatterns);
  ASSERT_EQ(scores.size(), kPatterns);
  for (const MeshScores& of_pattern : scores) {
    for (const MeshScore& score : of_pattern.of_densities) {
      EXPECT_GT(score.ms, 0.0);
      EXPECT_GT(score.rms, 1e-5);
      EXPECT_LT(score.rms, 5e-3);
    }
  }
  const EarlierCurve earlier = read_earlier(std::filesystem::path(PLEAT_FINE_DIR) / "earlier.json");
  const std::string svg = draw_meshes({&scene}, {scores}, earlier);
  EXPECT_NE(svg.find(earlier.name), std::string::npos);
  EXPECT_NE(svg.find("staggered rows"), std::string::npos);
}

TEST(Meshes, ShiftedRowsHaveNoMiddleLineToPin) {
  RestScene scene = scene_named("strip");
  scene.coarse.fill({3, 11});
  const std::vector<MeshScores> scores =
      score_meshes(api(), scene, rest_settings(api(), scene), read_reference(PLEAT_FINE_DIR, scene), [] {});
  EXPECT_EQ(scores.size(), kPatterns - 1);
}

TEST(Meshes, AnEarlierCurveThatIsNotThereIsNamed) { EXPECT_THROW(read_earlier("no/such/file.json"), demo::InputError); }

}  // namespace
}  // namespace pleat::bench
