#include "bench/stability/heat_map.h"

#include <algorithm>

#include "bench/svg.h"

namespace pleat::bench {
namespace {

constexpr int kCell = 9, kGap = 14, kLeft = 96, kTop = 64, kTitle = 30;  // pixels

/// Green to yellow to red, dark where nothing is left; the first is that of cells that hardly stretch at all.
constexpr const char* kColours[] = {"#1f6f3a", "#6cbf85", "#e8c531", "#e2792c", "#c02a2a", "#6a2a7a", "#111111"};
constexpr const char* kLegend[] = {"below 1 %",    "1 to 10 %",   "10 to 100 %", "100 to 1000 %",
                                   "above 1000 %", "thrown away", "not finite"};

const char* colour_of(const CellResult& cell) {
  return kColours[cell.fate == Fate::kBelow10 && cell.final_strain < 0.01 ? 0 : 1 + size_t(cell.fate)];
}

}  // namespace

std::string heat_map(const StabilityGrid& grid, std::span<const CellResult> results,
                     std::span<const std::string> names) {
  const int columns = int(grid.stiffness.size()), rows = int(grid.rate.size());
  const int block_width = columns * kCell + kGap, block_height = rows * kCell + kGap;
  const int band = int(grid.gravity.size()) * block_height + kTitle;
  const int width = std::max(kLeft + int(grid.mass_ratio.size()) * block_width, 660);
  const int height = kTop + int(grid.integrators.size()) * band + 8;
  Svg svg(width, height);
  svg.text(8, 16,
           "Largest elongation of an edge after " + number("%g", grid.seconds) + " s. In each block: stiffness " +
               number("%g", grid.stiffness.front()) + " to " + number("%g", grid.stiffness.back()) +
               " N/m to the right,");
  svg.text(8, 30,
           "tick 1/" + number("%g", grid.rate.front()) + " to 1/" + number("%g", grid.rate.back()) +
               " s downwards. Blocks: hem weight to the right, gravity downwards.");
  for (int k = 0; k < 7; ++k) {
    svg.add("<rect x=\"%d\" y=\"38\" width=\"9\" height=\"9\" fill=\"%s\"/>", 8 + 92 * k, kColours[k]);
    svg.text(20 + 92 * k, 46, kLegend[k]);
  }
  for (size_t index = 0; index < results.size(); ++index) {
    size_t rest = index;
    const auto next = [&rest](size_t size) {
      const size_t i = rest % size;
      rest /= size;
      return int(i);
    };
    const int column = next(grid.stiffness.size()), row = next(grid.rate.size());
    const int block = next(grid.mass_ratio.size()), line = next(grid.gravity.size()), integrator = int(rest);
    const int x = kLeft + block * block_width, y = kTop + integrator * band + kTitle + line * block_height;
    if (column == 0 && row == 0) {
      if (line == 0) svg.text(x, y - 4, number("hem x %g", grid.mass_ratio[size_t(block)]));
      if (block == 0) svg.text(kLeft - 6, y + 10, number("gravity x %g", grid.gravity[size_t(line)]), "end");
      if (block == 0 && line == 0)
        svg.text(8, y - 16, "<tspan font-weight=\"bold\">" + names[size_t(integrator)] + "</tspan>");
    }
    svg.add("<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\"/>\n", x + column * kCell, y + row * kCell,
            kCell - 1, kCell - 1, colour_of(results[index]));
  }
  return svg.finish();
}

}  // namespace pleat::bench
