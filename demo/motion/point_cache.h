#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <vector>

namespace pleat::demo {

/// Positions of the same points at successive moments.
struct PointCache {
  std::size_t points = 0, samples = 0;
  std::vector<float> positions;  ///< (samples, points, 3) m

  /// Between two samples in a straight line, (points,3); `sample` is clamped to the first and the last.
  std::vector<float> at(double sample) const;
};

/// Reads a PC2 point cache, little endian: "POINTCACHE2\0", int32 version 1, int32 points, float32 start and rate,
/// int32 samples, then the positions. `name` stands for the file in messages. Throws InputError for another format, a
/// file cut short, a position that is not finite, or more than 2^28 numbers.
PointCache read_point_cache(std::istream& stream, const std::string& name);

}  // namespace pleat::demo
