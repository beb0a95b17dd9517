#pragma once

#include <cstdint>
#include <span>

namespace pleat::bench {

/// Area of a triangle mesh, m2. positions: (V,3) m; triangles: (T,3).
double mesh_area(std::span<const float> positions, std::span<const uint32_t> triangles);

/// How much shorter or longer edges are than at rest, |length / rest length - 1|.
struct LengthError {
  double median_percent, p99_percent;
};

/// edges: (E,2) particles, E >= 1; rest_lengths: (E) m, > 0; positions: (P,3) m.
LengthError length_error(std::span<const float> positions, std::span<const uint32_t> edges,
                         std::span<const float> rest_lengths);

}  // namespace pleat::bench
