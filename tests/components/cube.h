// A cube of side 1 around the origin: 8 vertices, 12 triangles.
#pragma once

#include "components/shapes.h"

namespace pleat {

inline Mesh make_cube() {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const auto side = [&](std::uint32_t bit) { return (i >> bit & 1) != 0 ? 0.5f : -0.5f; };
    mesh.positions.push_back({side(0), side(1), side(2)});
  }
  const std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

}  // namespace pleat
