#pragma once

#include <cstdint>
#include <vector>

#include "demo/quality/distance.h"
#include "demo/scenes/triangle_mesh.h"

namespace pleat::bench {

/// An orthographic picture that knows only where something is.
struct Silhouette {
  uint32_t size;              ///< pixels a side
  std::vector<bool> covered;  ///< row by row
};

/// What of the picture to see: `axes` right and up are unit and square to each other, `centre` is in its middle.
struct SilhouetteView {
  demo::Vector3d right, up, centre;
  double width;  ///< m, across the picture and down
};

/// A pixel is covered where its middle lies in a triangle.
Silhouette draw_silhouette(const demo::TriangleMesh& mesh, const SilhouetteView& view, uint32_t size);

/// Area that both silhouettes cover over the area that either does, mean over 8 views around the vertical axis, 45
/// degrees apart and 20 degrees from above, of `size` pixels a side: 1 for the same surface, 0 for surfaces that are
/// nowhere before each other. The picture holds both.
double silhouette_overlap(const demo::TriangleMesh& a, const demo::TriangleMesh& b, uint32_t size = 512);

}  // namespace pleat::bench
