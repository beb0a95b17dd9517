#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "demo/scenes/scene.h"

namespace pleat::demo {

/// A cloth as it is drawn, in one vertex buffer like an engine's.
struct DrawnSurface {
  struct Vertex {
    float position[3], normal[3];
  };
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;  ///< 3 a triangle

  std::vector<float> positions() const;  ///< (V,3)
};

/// Makes room and reads the triangles; the vertices are read frame by frame.
DrawnSurface make_surface(const Scene& scene, size_t cloth);
void read_vertices(const Scene& scene, size_t cloth, DrawnSurface& surface);

/// Whether all positions and normals are finite numbers.
bool all_finite(const DrawnSurface& surface);

struct SurfaceTopology {
  size_t border_edges;  ///< edges in one triangle only
  bool manifold;        ///< every other edge is in exactly two triangles, which run through it in opposite directions
};
SurfaceTopology inspect_topology(std::span<const uint32_t> triangles);

}  // namespace pleat::demo
