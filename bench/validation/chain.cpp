#include "bench/validation/chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleat::bench {

double stretched(const Chain& chain, double tension) {
  return 0.5 * chain.link * (1.0 + std::sqrt(1.0 + 4.0 * tension / (chain.stiffness * chain.link)));
}

namespace {

/// Weight below the upper end of each link.
std::vector<double> hanging_tensions(const Chain& chain) {
  std::vector<double> tension(chain.node.size());
  double weight = 0.0;
  for (size_t i = tension.size(); i-- > 0;) tension[i] = weight += kGravity * chain.node[i];
  return tension;
}

/// Slope dF/dz of each link for a sideways displacement.
std::vector<double> sideways_stiffness(const Chain& chain) {
  std::vector<double> slope = hanging_tensions(chain);
  for (double& s : slope) s /= stretched(chain, s);
  return slope;
}

/// How many squared frequencies lie below `square`: the number of negative pivots of K - square M (Sylvester).
int frequencies_below(const Chain& chain, const std::vector<double>& slope, double square) {
  int count = 0;
  double pivot = 1.0;
  for (size_t i = 0; i < slope.size(); ++i) {
    const double next = i + 1 < slope.size() ? slope[i + 1] : 0.0;
    const double coupling = i == 0 ? 0.0 : slope[i] * slope[i] / pivot;
    pivot = slope[i] + next - square * chain.node[i] - coupling;
    if (pivot < 0.0) ++count;
  }
  return count;
}

}  // namespace

std::vector<double> hanging_lengths(const Chain& chain) {
  std::vector<double> lengths = hanging_tensions(chain);
  for (double& l : lengths) l = stretched(chain, l);
  return lengths;
}

Swing hanging_swing(const Chain& chain, int mode) {
  const std::vector<double> slope = sideways_stiffness(chain);
  double low = 0.0, high = 1.0;
  while (frequencies_below(chain, slope, high) < mode) high *= 2.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (frequencies_below(chain, slope, middle) < mode ? low : high) = middle;
  }
  // From the free end up: the links below a node carry what accelerates all that hangs there.
  std::vector<double> shape(slope.size(), 1.0);
  double pull = 0.0;
  for (size_t i = slope.size(); i-- > 1;) {
    pull += low * chain.node[i] * shape[i];
    shape[i - 1] = shape[i] - pull / slope[i];
  }
  return {2.0 * std::numbers::pi / std::sqrt(low), shape};
}

double sag(const Chain& chain, double span) {
  const size_t links = chain.node.size();
  // By symmetry each end carries half of what lies between them.
  double half = 0.0;
  for (size_t i = 0; i + 1 < links; ++i) half += 0.5 * kGravity * chain.node[i];
  const auto reach = [&](double horizontal, double& depth) {
    double x = 0.0, y = 0.0, vertical = half;
    depth = 0.0;
    for (size_t i = 0; i < links; ++i) {
      const double tension = std::hypot(horizontal, vertical), l = stretched(chain, tension);
      x += l * horizontal / tension;
      y += l * vertical / tension;
      depth = std::max(depth, y);
      vertical -= kGravity * chain.node[i];
    }
    return x;
  };
  double low = 0.0, high = half, depth = 0.0;
  while (reach(high, depth) < span) high *= 2.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (reach(middle, depth) < span ? low : high) = middle;
  }
  reach(0.5 * (low + high), depth);
  return depth;
}

}  // namespace pleat::bench
