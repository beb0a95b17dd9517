// Mesh makers for common garments.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/mesh.h"

namespace pleat {

struct Mesh {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

struct GridShape {
  std::uint32_t rows = 9, columns = 9;  // particles, at least 2 each
  float width = 1.0f, depth = 1.0f;     // extent in x and in z, m
  bool alternate = false;               // diagonals alternate from quad to quad
};

/// A horizontal sheet around the origin, y = 0. Particle (i, j) of row i has index i columns + j and lies at
/// x = (j / (columns - 1) - 1/2) width, z = (i / (rows - 1) - 1/2) depth. The quad (a, b = a + 1, c = a + columns,
/// d = c + 1) becomes (a, c, d), (a, d, b), or where alternate turns it (a, c, b), (b, c, d).
Mesh make_grid(const GridShape& shape);

struct Ring {
  std::uint32_t size;  // particles, at least 3
  float radius;        // m
  float height;        // y, m
};

/// A tube from the top ring down. Particle i of c stands at angle a = 2 pi i / c: (R sin a, y, R cos a). Two
/// neighbouring rings are joined by a strip that takes, at each turn, the ring whose next particle comes first.
Mesh make_rings(std::span<const Ring> rings);

}  // namespace pleat
