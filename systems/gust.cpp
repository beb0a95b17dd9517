#include "systems/gust.h"

#include <cmath>

namespace pleat {
namespace {

/// Uniform in [-1, 1): a counter, mixed.
///   G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number Generators", 2014: SplitMix64.
float random_value(std::uint64_t seed, std::uint64_t axis, std::int64_t knot) {
  std::uint64_t z = (seed + 1) * 0x9e3779b97f4a7c15u + 3 * static_cast<std::uint64_t>(knot) + axis;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<float>(z >> 40) / 8388608.0f - 1.0f;
}

}  // namespace

bool Gust::validate() const {
  return is_finite(wind) && strength >= 0.0f && frequency > 0.0f && time >= 0.0 && air != nullptr;
}

void Gust::run() const {
  // Random values have variance 1/3; the spline's weights have a mean sum of squares of 151/315.
  constexpr float kUnit = 2.5016388f;
  const double knots = time * 2.0 * static_cast<double>(frequency), whole = std::floor(knots);
  const std::int64_t first = static_cast<std::int64_t>(whole);
  const float u = static_cast<float>(knots - whole), v = 1.0f - u;
  const float weight[4] = {v * v * v / 6.0f, (3.0f * u * u * u - 6.0f * u * u + 4.0f) / 6.0f,
                           (3.0f * v * v * v - 6.0f * v * v + 4.0f) / 6.0f, u * u * u / 6.0f};
  float noise[3] = {};
  for (std::uint64_t axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 4; ++k) noise[axis] += weight[k] * random_value(seed, axis, first + k);
  }
  *air = wind + Vec3{noise[0], noise[1], noise[2]} * (strength * kUnit);
}

}  // namespace pleat
