// Stiff and extreme cloths: the grid of which `stability_map` runs every cell.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "demo/scenes/scene_def.h"
#include "engine/pleat.h"

namespace pleat::bench {

/// One cloth of the map.
struct Cell {
  uint32_t integrator;  ///< PLEAT_INTEGRATOR_*
  double stiffness;     ///< k of eq (1), N/m
  double rate;          ///< ticks a second
  double mass_ratio;    ///< of a particle of the free hem to one inside
  double gravity;       ///< times 9.81 m/s2
};

/// The values along each axis; every combination is a cell.
struct StabilityGrid {
  std::vector<uint32_t> integrators;
  std::vector<double> stiffness, rate, mass_ratio, gravity;
  double seconds;  ///< simulated in each cell

  size_t cells_of_integrator() const { return stiffness.size() * rate.size() * mass_ratio.size() * gravity.size(); }
  size_t cells() const { return integrators.size() * cells_of_integrator(); }
  /// Integrator by integrator, within it gravity, mass ratio, rate, stiffness; the last changes fastest.
  Cell cell(size_t index) const;
};
StabilityGrid full_grid();
StabilityGrid quick_grid();

/// How a cell ended, from best to worst.
enum class Fate { kBelow10, k10To100, k100To1000, kAbove1000, kFarAway, kNonfinite };
inline constexpr std::array<std::string_view, 6> kFateNames = {"below_10_percent", "10_to_100", "100_to_1000",
                                                               "above_1000",       "far_away",  "nonfinite"};

struct CellResult {
  Fate fate = Fate::kNonfinite;
  double final_strain =
      0.0;  ///< largest elongation of an edge at the end, fraction; of no meaning for the last two fates
};

/// Lets `scene` (its garment and pins) hang for `seconds` from its start. A cell that leaves a sphere of 1 km, or is
/// not finite in any tick, ends there. Throws std::runtime_error where the library refuses it.
CellResult run_cell(const pleat_api& api, const demo::SceneDef& scene, const Cell& cell, double seconds);

}  // namespace pleat::bench
