#include "bench/metrics/wrinkle_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleat::bench {
namespace {

size_t band_of(double wavelength) {
  return size_t(std::ranges::find_if(kBandEnds, [=](double end) { return wavelength > end; }) - kBandEnds.begin());
}

void add_line(std::span<const float> points, double weight, WrinkleSpectrum& sum) {
  const WrinkleSpectrum line = line_spectrum(points);
  std::ranges::transform(sum, line, sum.begin(), [=](double s, double l) { return s + weight * l; });
}

}  // namespace

WrinkleSpectrum line_spectrum(std::span<const float> points) {
  const size_t steps = points.size() / 3 - 1;
  const auto n = double(steps);
  WrinkleSpectrum spectrum{};
  for (size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> away;
    for (size_t i = 0; i < steps; ++i) {
      away.push_back(double(points[3 * i + axis]) - std::lerp(points[axis], points[3 * steps + axis], double(i) / n));
    }
    for (size_t k = 1; k < steps; ++k) {
      double sum = 0.0;
      for (size_t i = 1; i < steps; ++i) sum += away[i] * std::sin(std::numbers::pi * double(k * i) / n);
      spectrum[band_of(2.0 / double(k))] += 2.0 * sum * sum / (n * n);
    }
  }
  return spectrum;
}

WrinkleSpectrum sheet_spectrum(std::span<const float> points, uint32_t rows, uint32_t columns) {
  WrinkleSpectrum sum{};
  for (size_t row = 0; row < rows; ++row) {
    add_line(points.subspan(3 * row * columns, size_t{3} * columns), 0.5 / rows, sum);
  }
  for (size_t column = 0; column < columns; ++column) {
    std::vector<float> line;
    for (size_t row = 0; row < rows; ++row) {
      const auto p = points.subspan(3 * (row * columns + column), 3);
      line.insert(line.end(), p.begin(), p.end());
    }
    add_line(line, 0.5 / columns, sum);
  }
  return sum;
}

}  // namespace pleat::bench
