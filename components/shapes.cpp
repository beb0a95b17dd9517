#include "components/shapes.h"

#include <cmath>
#include <numbers>

namespace pleat {

Mesh make_grid(const GridShape& shape) {
  Mesh mesh;
  mesh.positions.reserve(std::size_t{shape.rows} * shape.columns);
  for (std::uint32_t i = 0; i < shape.rows; ++i) {
    for (std::uint32_t j = 0; j < shape.columns; ++j) {
      const float u = static_cast<float>(j) / static_cast<float>(shape.columns - 1);
      const float v = static_cast<float>(i) / static_cast<float>(shape.rows - 1);
      mesh.positions.push_back({(u - 0.5f) * shape.width, 0.0f, (v - 0.5f) * shape.depth});
    }
  }
  for (std::uint32_t i = 0; i + 1 < shape.rows; ++i) {
    for (std::uint32_t j = 0; j + 1 < shape.columns; ++j) {
      const std::uint32_t a = i * shape.columns + j, b = a + 1, c = a + shape.columns, d = c + 1;
      const bool turned = shape.alternate && (i + j) % 2 == 1;
      mesh.triangles.push_back(turned ? Triangle{a, c, b} : Triangle{a, c, d});
      mesh.triangles.push_back(turned ? Triangle{b, c, d} : Triangle{a, d, b});
    }
  }
  return mesh;
}

Mesh make_rings(std::span<const Ring> rings) {
  Mesh mesh;
  for (const Ring& ring : rings) {
    for (std::uint32_t i = 0; i < ring.size; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / ring.size;
      mesh.positions.push_back({static_cast<float>(ring.radius * std::sin(angle)), ring.height,
                                static_cast<float>(ring.radius * std::cos(angle))});
    }
  }
  std::uint32_t top = 0;
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    const std::uint32_t n = rings[r].size, m = rings[r + 1].size, bottom = top + n;
    for (std::uint32_t i = 0, j = 0; i < n || j < m;) {
      // (i + 1) / n < (j + 1) / m, in whole numbers
      const bool top_is_next = j >= m || (i < n && std::uint64_t{i + 1} * m < std::uint64_t{j + 1} * n);
      const std::uint32_t a = top + i % n, b = bottom + j % m;
      if (top_is_next) {
        mesh.triangles.push_back({a, b, top + (i + 1) % n});
        ++i;
      } else {
        mesh.triangles.push_back({a, b, bottom + (j + 1) % m});
        ++j;
      }
    }
    top = bottom;
  }
  return mesh;
}

}  // namespace pleat
