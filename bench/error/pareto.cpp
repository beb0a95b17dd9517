#include "bench/error/pareto.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pleat::bench {

std::vector<size_t> pareto_front(std::span<const TimeAndError> points) {
  std::vector<size_t> by_time(points.size());
  std::iota(by_time.begin(), by_time.end(), size_t{0});
  std::ranges::sort(by_time, [&](size_t a, size_t b) {
    return points[a].time != points[b].time ? points[a].time < points[b].time : points[a].error < points[b].error;
  });
  std::vector<size_t> front;
  for (const size_t i : by_time) {
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  }
  return front;
}

std::optional<double> time_to_error(std::span<const TimeAndError> points, double error) {
  const std::vector<size_t> front = pareto_front(points);
  const auto reached = std::ranges::find_if(front, [&](size_t i) { return points[i].error <= error; });
  if (reached == front.end()) return {};
  const TimeAndError& here = points[*reached];
  if (reached == front.begin()) return here.time;
  const TimeAndError& before = points[*(reached - 1)];
  const double share = std::log(error / before.error) / std::log(here.error / before.error);
  return before.time * std::pow(here.time / before.time, share);
}

}  // namespace pleat::bench
