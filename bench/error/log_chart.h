#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/error/pareto.h"

namespace pleat::bench {

/// Points of one method, joined in the order given.
struct Curve {
  std::string name;  ///< the same in all panels: one line of the legend
  std::vector<TimeAndError> points;
};

struct Panel {
  std::string title;
  std::vector<Curve> curves;
};

/// Panels of error over time, both logarithmic, side by side on the same axes, with a legend. A ring is drawn around
/// the points that no other of their panel beats in both.
std::string log_charts(const std::string& title, const std::string& time_label, const std::string& error_label,
                       std::span<const Panel> panels);

}  // namespace pleat::bench
