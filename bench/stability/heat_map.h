#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bench/stability/grid.h"

namespace pleat::bench {

/// An SVG picture of all cells: a row of blocks for each integrator, a block for each mass ratio and gravity, in it
/// stiffness to the right and the tick's length downwards. `names` are the integrators', in the grid's order.
std::string heat_map(const StabilityGrid& grid, std::span<const CellResult> results,
                     std::span<const std::string> names);

}  // namespace pleat::bench
