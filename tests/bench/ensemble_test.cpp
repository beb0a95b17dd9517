// Statistics of many starts, on shapes whose answer is known.
#include "bench/error/ensemble.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/error/field.h"
#include "bench/fine_square.h"

namespace pleat::bench {
namespace {

const pleat_api& api() { return *pleat_get_api(PLEAT_API_MAJOR); }

/// A sheet of kFineSide^2 points hanging down from y = 0: waves of height a along it, `lift` before the plane.
std::vector<float> hanging(double a, double waves, double lift) {
  std::vector<float> points;
  for (uint32_t row = 0; row < kFineSide; ++row) {
    for (uint32_t column = 0; column < kFineSide; ++column) {
      const double u = double(column) / (kFineSide - 1), v = double(row) / (kFineSide - 1);
      const double z = lift + a * std::sin(2.0 * 3.14159265358979 * waves * u);
      points.insert(points.end(), {float(u), float(-v), float(z)});
    }
  }
  return points;
}

TEST(Ensemble, ScatterOfFourNumbers) {
  const double values[] = {1.0, 2.0, 3.0, 6.0};
  EXPECT_DOUBLE_EQ(scatter_of(values).mean, 3.0);
  EXPECT_NEAR(scatter_of(values).deviation, std::sqrt(14.0 / 3.0), 1e-12);
}

TEST(Ensemble, OfTwoLiftedSheets) {
  const std::vector<float> shapes[] = {hanging(0.02, 5.0, 0.0), hanging(0.02, 5.0, 0.1)};
  const Ensemble both = summarize(shapes);
  EXPECT_NEAR(both.spread, std::sqrt(2.0 * 0.05 * 0.05), 1e-6);
  EXPECT_NEAR(both.lowest.mean, -1.0, 1e-6);
  EXPECT_NEAR(both.lowest.deviation, 0.0, 1e-6);
  EXPECT_NEAR(both.deep.mean, 0.04, 1e-4);
  EXPECT_NEAR(both.wrinkles[2].mean, 0.25 * 0.02 * 0.02, 1e-6);  // .2 of the side, in rows only
  EXPECT_NEAR(both.mean[2], 0.05, 1e-6);
  const std::vector<float> other[] = {hanging(0.02, 5.0, 0.08), hanging(0.02, 5.0, 0.08)};
  EXPECT_NEAR(mean_distance(both, summarize(other)).rms, 0.03, 1e-6);
}

TEST(Ensemble, StartsDifferButNotAtPins) {
  for (const EnsembleScene& scene : ensemble_scenes()) {
    const Grid grid = scene.cloth.coarse[1];
    const std::vector<float> first = perturbed_start(scene.cloth, grid, 1),
                             second = perturbed_start(scene.cloth, grid, 2), plain = start_positions(scene.cloth, grid);
    double largest = 0.0;
    for (uint32_t row = 0; row < grid.rows; ++row) {
      for (uint32_t column = 0; column < grid.columns; ++column) {
        for (size_t axis = 0; axis < 3; ++axis) {
          const size_t i = 3 * (size_t{row} * grid.columns + column) + axis;
          if (scene.cloth.pinned(double(column) / (grid.columns - 1), double(row) / (grid.rows - 1))) {
            EXPECT_EQ(first[i], plain[i]);
          }
          largest = std::max(largest, std::abs(double(first[i]) - double(second[i])));
        }
      }
    }
    EXPECT_GT(largest, 0.003) << scene.cloth.name;
    EXPECT_LT(largest, 0.05) << scene.cloth.name;
  }
}

TEST(Ensemble, StartsOfTwoGridsAreTheSameWhereBothHaveParticles) {
  const RestScene& scene = ensemble_scenes()[0].cloth;
  const std::vector<float> coarse = perturbed_start(scene, {9, 9}, 3), fine = perturbed_start(scene, {17, 17}, 3);
  for (size_t row = 0; row < 9; ++row) {
    for (size_t column = 0; column < 9; ++column) {
      for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(coarse[3 * (9 * row + column) + axis], fine[3 * (17 * 2 * row + 2 * column) + axis], 1e-6);
      }
    }
  }
}

/// After no time what is drawn flat are the starts themselves.
TEST(Ensemble, IsTakenAtTheRightPlacesOfTheSheet) {
  EnsembleScene scene = ensemble_scenes()[0];
  scene.seconds = 0.0;
  const Grid grid = {9, 9};
  const Dynamics dynamics{"default", grid, rest_settings(api(), scene.cloth), {}};
  const Ensemble flat = run_members(api(), scene, dynamics, {{"flat", PLEAT_SURFACE_FLAT, 1}}, [] {})[0];
  std::vector<double> mean(3 * size_t{kFineSide} * kFineSide);
  for (uint32_t seed = 1; seed <= kMembers; ++seed) {
    const std::vector<float> start = perturbed_start(scene.cloth, grid, seed);
    for (size_t row = 0; row < 9; ++row) {
      for (size_t column = 0; column < 9; ++column) {
        for (size_t axis = 0; axis < 3; ++axis) {
          mean[3 * (kFineSide * 8 * row + 8 * column) + axis] +=
              double(start[3 * (9 * row + column) + axis]) / kMembers;
        }
      }
    }
  }
  for (size_t row = 0; row < 9; ++row) {
    for (size_t column = 0; column < 9; ++column) {
      for (size_t axis = 0; axis < 3; ++axis) {
        const size_t i = 3 * (kFineSide * 8 * row + 8 * column) + axis;
        EXPECT_NEAR(flat.mean[i], mean[i], 1e-5) << row << ' ' << column;
      }
    }
  }
}

/// As far as eight starts can tell; bench/README.md says what still depends on it.
TEST(Ensemble, MeanShapesDependLittleOnTheMesh) {
  for (const EnsembleScene& scene : ensemble_scenes()) {
    const EnsembleReference reference = read_ensemble(PLEAT_FINE_DIR, scene);
    const MeanDistance apart = mean_distance(reference.fine, reference.half);
    EXPECT_GT(apart.rms, 0.0) << scene.cloth.name;
    EXPECT_LT(apart.rms, 3.0 * apart.chance) << scene.cloth.name;
  }
}

}  // namespace
}  // namespace pleat::bench
