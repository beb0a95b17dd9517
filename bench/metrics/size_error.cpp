#include "bench/metrics/size_error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pleat::bench {
namespace {

Eigen::Vector3d point(std::span<const float> positions, size_t i) {
  return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

}  // namespace

double mesh_area(std::span<const float> positions, std::span<const uint32_t> triangles) {
  double area = 0.0;
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Eigen::Vector3d a = point(positions, triangles[t]), b = point(positions, triangles[t + 1]),
                          c = point(positions, triangles[t + 2]);
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

LengthError length_error(std::span<const float> positions, std::span<const uint32_t> edges,
                         std::span<const float> rest_lengths) {
  std::vector<double> errors;
  for (size_t e = 0; e < rest_lengths.size(); ++e) {
    const double length = (point(positions, edges[2 * e]) - point(positions, edges[2 * e + 1])).norm();
    errors.push_back(100.0 * std::abs(length / double(rest_lengths[e]) - 1.0));
  }
  std::ranges::sort(errors);
  const auto at = [&errors](double share) { return errors[size_t(share * double(errors.size() - 1) + 0.5)]; };
  return {at(0.5), at(0.99)};
}

}  // namespace pleat::bench
