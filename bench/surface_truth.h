#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/fine_square.h"

namespace pleat::bench {

/// A surface known at kFineSide^2 points, in the order of flat_square.
struct SurfaceTruth {
  std::string name;
  std::vector<float> positions;  ///< (kFineSide^2, 3) m
  bool flat_at_rest;             ///< a sheet that was bent, or a garment that has this shape at rest
};

/// The hanging squares kept in `folder`, then
///   cylinder  the sheet rolled by 2 rad around an axis askew to its threads; nothing is stretched
///   sphere    the cap of radius .6 m that reaches 1.2 rad from corner to corner
///   saddle    y = .8 x z over a square of 1 m
/// Throws InputError where a file cannot be read.
std::vector<SurfaceTruth> surface_truths(const std::filesystem::path& folder);

/// Every step-th of n x n points, row by row.
std::vector<float> every(std::span<const float> positions, uint32_t n, uint32_t step);

}  // namespace pleat::bench
