#include "bench/scaling/growth_chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/svg.h"

namespace pleat::bench {
namespace {

constexpr int kWidth = 440, kHeight = 240, kLeft = 52, kTop = 44, kRight = 16, kBottom = 44;  // pixels
constexpr std::array kColours = {"#0072b2", "#d55e00"};
constexpr double kBand = 1.25, kLeast = 0.5;

/// From its ends to pixels, logarithmically.
struct Axis {
  double low, high;
  int from, to;
  double at(double value) const { return from + (to - from) * std::log(value / low) / std::log(high / low); }
};

}  // namespace

std::string growth_chart(std::span<const Growth> scenes) {
  double fewest = HUGE_VAL, most = 0.0, dearest = 2.0;
  for (const Growth& scene : scenes) {
    for (const SizeCost& cost : scene.sizes) {
      fewest = std::min(fewest, double(cost.particles)), most = std::max(most, double(cost.particles));
      dearest = std::max(dearest, scene.ratio(cost));
    }
  }
  const Axis x{fewest / 1.3, most * 1.3, kLeft, kLeft + kWidth};
  const Axis y{kLeast, std::exp2(std::ceil(std::log2(dearest))), kTop + kHeight, kTop};
  Svg svg(kLeft + kWidth + kRight, kTop + kHeight + kBottom, 11);
  svg.text(8, 16, "Processor time a particle and frame, over that in the middle of a scene's sizes");
  svg.add("<rect x=\"%d\" y=\"%.1f\" width=\"%d\" height=\"%.1f\" fill=\"#e6f2e6\"/>\n", kLeft, y.at(kBand), kWidth,
          y.at(1.0 / kBand) - y.at(kBand));
  for (double value = kLeast; value <= y.high; value *= 2.0) {
    svg.add("<path d=\"M%d %.1f h%d\" stroke=\"#d8d8d8\"/>\n", kLeft, y.at(value), kWidth);
    svg.text(kLeft - 6, y.at(value) + 4, number("%g", value), "end");
  }
  for (double value = std::pow(10.0, std::ceil(std::log10(x.low))); value <= x.high; value *= 10.0) {
    svg.add("<path d=\"M%.1f %d v%d\" stroke=\"#d8d8d8\"/>\n", x.at(value), kTop, kHeight);
    svg.text(x.at(value), kTop + kHeight + 15, number("%g", value), "middle");
  }
  svg.text(kLeft + kWidth / 2, kTop + kHeight + 34, "particles", "middle");
  for (size_t k = 0; k < scenes.size(); ++k) {
    const char* colour = kColours[k % kColours.size()];
    std::string path;
    for (const SizeCost& cost : scenes[k].sizes) {
      const double at_x = x.at(double(cost.particles)), at_y = y.at(scenes[k].ratio(cost));
      path += (path.empty() ? 'M' : 'L') + number("%.1f", at_x) + " " + number("%.1f", at_y);
      svg.add("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n", at_x, at_y, colour);
    }
    svg.raw("<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour + "\"/>\n");
    svg.text(kLeft + 8, kTop + 14.0 * double(k + 1),
             "<tspan fill=\"" + std::string(colour) + "\">" + scenes[k].scene + ", " +
                 number("%.0f", scenes[k].middle().ns_a_particle()) + " ns in the middle</tspan>");
  }
  return svg.finish();
}

}  // namespace pleat::bench
