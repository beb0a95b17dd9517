#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace pleat::demo {

/// Where a surface passes through itself, or one through another.
struct Crossings {
  size_t count = 0;  ///< edges through a triangle
  double deepest =
      0.0;  ///< m: of each crossing, how far the nearer end of the edge has come through the triangle's plane
};

/// Edges of a mesh that pass through its triangles, but for those that share a corner.
/// positions: (V,3) m; triangles: (T,3).
Crossings find_crossings(std::span<const float> positions, std::span<const uint32_t> triangles);

}  // namespace pleat::demo
