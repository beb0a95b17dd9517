#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pleat::demo {

struct TriangleMesh {
  std::vector<float> positions;     ///< (V,3) m
  std::vector<float> uvs;           ///< (V,2), or empty
  std::vector<uint32_t> triangles;  ///< (T,3) vertex indices, counter-clockwise seen from outside

  size_t vertex_count() const { return positions.size() / 3; }
  size_t triangle_count() const { return triangles.size() / 3; }
};

}  // namespace pleat::demo
