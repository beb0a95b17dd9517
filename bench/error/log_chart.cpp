#include "bench/error/log_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/svg.h"

namespace pleat::bench {
namespace {

constexpr int kWidth = 330, kHeight = 250;                                  // of a panel's axes, pixels
constexpr int kLeft = 62, kTop = 56, kGapX = 30, kGapY = 66, kColumns = 3;  // around them

/// Told apart by people who see few colours, too: each curve has a marker of its own as well. After M. Okabe and K.
/// Ito.
constexpr std::array kColours = {"#000000", "#0072b2", "#e69f00", "#009e73", "#d55e00",
                                 "#cc79a7", "#56b4e9", "#7a5c00", "#999999", "#5a3fc0"};

struct Axis {
  double low, high;  // decades
  int pixels;
  double at(double value) const { return (std::log10(value) - low) / (high - low) * pixels; }
};

/// Whole decades, and 2 and 5 of each where words of `room` pixels do not meet.
std::vector<double> ticks(const Axis& axis, double room) {
  const bool between = 0.3 * axis.pixels / (axis.high - axis.low) >= room;
  std::vector<double> all;
  for (int decade = int(std::floor(axis.low)); decade <= int(std::ceil(axis.high)); ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (digit > 1.0 && !between) continue;
      const double value = digit * std::pow(10.0, decade);
      if (const double x = std::log10(value); x >= axis.low - 1e-9 && x <= axis.high + 1e-9) all.push_back(value);
    }
  }
  return all;
}

void marker(Svg& svg, size_t kind, double x, double y) {
  const char* colour = kColours[kind % kColours.size()];
  switch (kind % 4) {
    case 0:
      return svg.add("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>\n", x, y, colour);
    case 1:
      return svg.add("<rect x=\"%.1f\" y=\"%.1f\" width=\"6\" height=\"6\" fill=\"%s\"/>\n", x - 3, y - 3, colour);
    case 2:
      return svg.add("<path d=\"M%.1f %.1f l4 7 h-8 z\" fill=\"%s\"/>\n", x, y - 4.5, colour);
    default:
      return svg.add("<path d=\"M%.1f %.1f l4 4 l-4 4 l-4 -4 z\" fill=\"%s\"/>\n", x, y - 4.0, colour);
  }
}

void draw_axes(Svg& svg, const Axis& time, const Axis& error, double x0, double y0) {
  for (const double value : ticks(time, 30.0)) {
    const double x = x0 + time.at(value);
    svg.add("<path d=\"M%.1f %.1f v%d\" stroke=\"#e4e4e4\"/>\n", x, y0, kHeight);
    svg.text(x, y0 + kHeight + 13, number("%g", value), "middle");
  }
  for (const double value : ticks(error, 12.0)) {
    const double y = y0 + kHeight - error.at(value);
    svg.add("<path d=\"M%.1f %.1f h%d\" stroke=\"#e4e4e4\"/>\n", x0, y, kWidth);
    svg.text(x0 - 5, y + 4, number("%g", value), "end");
  }
  svg.add("<rect x=\"%.1f\" y=\"%.1f\" width=\"%d\" height=\"%d\" fill=\"none\" stroke=\"#444\"/>\n", x0, y0, kWidth,
          kHeight);
}

void draw_panel(Svg& svg, const Panel& panel, const std::vector<std::string>& names, const Axis& time,
                const Axis& error, double x0, double y0) {
  draw_axes(svg, time, error, x0, y0);
  svg.text(x0, y0 - 7, "<tspan font-weight=\"bold\">" + panel.title + "</tspan>");
  const auto place = [&](const TimeAndError& p) {
    return std::array{x0 + time.at(p.time), y0 + kHeight - error.at(p.error)};
  };
  std::vector<TimeAndError> all;
  for (const Curve& curve : panel.curves) {
    const auto kind = size_t(std::ranges::find(names, curve.name) - names.begin());
    std::string path;
    for (const TimeAndError& point : curve.points) {
      const auto [x, y] = place(point);
      path += (path.empty() ? "M" : " L") + number("%.1f", x) + number(" %.1f", y);
      all.push_back(point);
    }
    svg.add("<path fill=\"none\" stroke=\"%s\" stroke-opacity=\".55\" d=\"", kColours[kind % kColours.size()]);
    svg.raw(path + "\"/>\n");
    for (const TimeAndError& point : curve.points) marker(svg, kind, place(point)[0], place(point)[1]);
  }
  for (const size_t i : pareto_front(all)) {
    const auto [x, y] = place(all[i]);
    svg.add("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"6\" fill=\"none\" stroke=\"#c00000\"/>\n", x, y);
  }
}

/// From the least to the greatest of all panels, and a little more.
template <class F>
Axis axis_over(std::span<const Panel> panels, int pixels, F value) {
  double low = std::numeric_limits<double>::max(), high = 0.0;
  for (const Panel& panel : panels) {
    for (const Curve& curve : panel.curves) {
      for (const TimeAndError& point : curve.points) {
        low = std::min(low, value(point));
        high = std::max(high, value(point));
      }
    }
  }
  return {std::log10(low) - 0.08, std::log10(high) + 0.08, pixels};
}

}  // namespace

std::string log_charts(const std::string& title, const std::string& time_label, const std::string& error_label,
                       std::span<const Panel> panels) {
  const Axis time = axis_over(panels, kWidth, [](const TimeAndError& p) { return p.time; });
  const Axis error = axis_over(panels, kHeight, [](const TimeAndError& p) { return p.error; });
  std::vector<std::string> names;
  for (const Panel& panel : panels) {
    for (const Curve& curve : panel.curves) {
      if (std::ranges::find(names, curve.name) == names.end()) names.push_back(curve.name);
    }
  }
  const auto slots = int(panels.size()) + 1, columns = std::min(slots, kColumns),
             rows = (slots + columns - 1) / columns;
  Svg svg(kLeft + columns * (kWidth + kGapX + kLeft / 2), kTop + rows * (kHeight + kGapY), 11);
  svg.text(12, 20, "<tspan font-weight=\"bold\" font-size=\"14\">" + title + "</tspan>");
  const auto corner = [&](int slot) {
    return std::array{double(kLeft + slot % columns * (kWidth + kGapX + kLeft / 2)),
                      double(kTop + slot / columns * (kHeight + kGapY))};
  };
  for (size_t i = 0; i < panels.size(); ++i) {
    const auto [x, y] = corner(int(i));
    draw_panel(svg, panels[i], names, time, error, x, y);
    svg.text(x + kWidth / 2, y + kHeight + 29, time_label, "middle");
    svg.add("<text transform=\"translate(%.1f %.1f) rotate(-90)\" text-anchor=\"middle\">", x - 40, y + kHeight / 2);
    svg.raw(error_label + "</text>\n");
  }
  auto [x, y] = corner(int(panels.size()));
  for (size_t i = 0; i < names.size(); ++i) {
    marker(svg, i, x + 8, y + 8 + 18.0 * double(i));
    svg.text(x + 20, y + 12 + 18.0 * double(i), names[i]);
  }
  const double last = y + 8 + 18.0 * double(names.size());
  svg.add("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"6\" fill=\"none\" stroke=\"#c00000\"/>\n", x + 8, last);
  svg.text(x + 20, last + 4, "no other point is both faster and closer");
  return svg.finish();
}

}  // namespace pleat::bench
