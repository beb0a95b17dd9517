#include "bench/surface_truth.h"

#include <cmath>

#include "demo/quality/distance.h"

namespace pleat::bench {
namespace {

/// x, z in -.5 .. .5 m -> a point of the surface.
template <class F>
std::vector<float> sample(F surface) {
  std::vector<float> positions;
  for (uint32_t row = 0; row < kFineSide; ++row) {
    for (uint32_t column = 0; column < kFineSide; ++column) {
      const double x = double(column) / (kFineSide - 1) - 0.5, z = double(row) / (kFineSide - 1) - 0.5;
      for (const double coordinate : demo::Vector3d(surface(x, z))) positions.push_back(float(coordinate));
    }
  }
  return positions;
}

demo::Vector3d on_cylinder(double x, double z) {
  constexpr double kRadius = 0.5, kAskew = 0.35;
  const double along = x * std::cos(kAskew) - z * std::sin(kAskew),
               across = x * std::sin(kAskew) + z * std::cos(kAskew);
  return {along, kRadius * std::cos(across / kRadius), kRadius * std::sin(across / kRadius)};
}

demo::Vector3d on_sphere(double x, double z) {
  constexpr double kRadius = 0.6;
  const double r = std::hypot(x, z), angle = r / kRadius;
  const double outward = r > 0.0 ? kRadius * std::sin(angle) / r : 1.0;
  return {x * outward, kRadius * std::cos(angle), z * outward};
}

demo::Vector3d on_saddle(double x, double z) { return {x, 0.8 * x * z, z}; }

}  // namespace

std::vector<SurfaceTruth> surface_truths(const std::filesystem::path& folder) {
  std::vector<SurfaceTruth> truths;
  for (const FineSquare& square : kFineSquares) truths.push_back({square.name, read_fine(folder, square.name), true});
  truths.push_back({"cylinder", sample(on_cylinder), true});
  truths.push_back({"sphere", sample(on_sphere), false});
  truths.push_back({"saddle", sample(on_saddle), false});
  return truths;
}

std::vector<float> every(std::span<const float> positions, uint32_t n, uint32_t step) {
  std::vector<float> kept;
  for (uint32_t row = 0; row < n; row += step) {
    for (uint32_t column = 0; column < n; column += step) {
      const float* p = &positions[3 * (size_t{row} * n + column)];
      kept.insert(kept.end(), p, p + 3);
    }
  }
  return kept;
}

}  // namespace pleat::bench
