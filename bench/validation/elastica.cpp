#include "bench/validation/elastica.h"

#include <cmath>
#include <numbers>

namespace pleat::bench {
namespace {

struct Tip {
  double clamp_angle, width, height;
};

/// From the free end, whose last link is inclined by `angle`, to the clamp: the moment of what hangs beyond a node
/// turns the link before it. L = 1, sigma g = 1, B = 1 / gamma.
Tip shoot(double gamma, uint32_t cells, double angle) {
  const double a = 1.0 / (cells + 0.5);
  double load = 0.0, moment = 0.0, width = 0.0, height = 0.0;
  for (uint32_t i = cells; i >= 1; --i) {
    load += i == cells ? a / 2 : a;
    const double dx = a * std::cos(angle);
    moment += load * dx;
    width += dx;
    height += a * std::sin(angle);
    angle -= moment * gamma * a;
  }
  return {angle, width + a / 2, height};
}

}  // namespace

double elastica_droop(double gamma, uint32_t cells) {
  // The inclination of the tip, 0 to a right angle, at which the link in the clamp is level.
  double low = 0.0, high = std::numbers::pi / 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(gamma, cells, middle).clamp_angle < 0.0 ? low : high) = middle;
  }
  const Tip tip = shoot(gamma, cells, low);
  return tip.height / tip.width;
}

}  // namespace pleat::bench
