#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pleat::bench {

/// Wavelengths, as a share of the line's length at rest, that the bands end at: the first band is all longer waves than
/// the first, the last all shorter than the last.
inline constexpr std::array<double, 5> kBandEnds = {0.6, 0.3, 0.15, 0.075, 0.0375};
using WrinkleSpectrum = std::array<double, kBandEnds.size() + 1>;

/// How much a line waves at each wavelength: the mean square of its distance from a straight line that is evenly spaced
/// between its ends, m2, by bands of wavelengths along it at rest. Sums to that mean square.
/// points: (N,3) m, evenly spaced at rest, N >= 2. By the sine transform, as that distance is zero at both ends; its
/// k-th wave is 2 / k lines long.
WrinkleSpectrum line_spectrum(std::span<const float> points);

/// Mean over the rows and over the columns of a sheet of rows x columns points, row by row, (rows columns,3) m.
WrinkleSpectrum sheet_spectrum(std::span<const float> points, uint32_t rows, uint32_t columns);

}  // namespace pleat::bench
