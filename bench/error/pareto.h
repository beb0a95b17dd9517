#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pleat::bench {

/// What a method costs and how wrong it is.
struct TimeAndError {
  double time, error;  ///< both > 0; units are the caller's
};

/// Indices of the points that no other point beats in both, by time.
std::vector<size_t> pareto_front(std::span<const TimeAndError> points);

/// The least time in which `points` reach an error, on their front and on straight lines in log-log between its points.
/// None where none reaches it; that of the first point where all do.
std::optional<double> time_to_error(std::span<const TimeAndError> points, double error);

}  // namespace pleat::bench
