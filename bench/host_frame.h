// What a host does in a frame, to be timed.
#pragma once

#include <algorithm>
#include <vector>

#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"

namespace pleat::bench {

/// A buffer for what each cloth in sight draws.
inline std::vector<demo::DrawnSurface> make_surfaces(const demo::Scene& scene) {
  std::vector<demo::DrawnSurface> surfaces;
  const size_t seen = std::min(scene.def().seen, scene.cloths().size());
  for (size_t k = 0; k < seen; ++k) surfaces.push_back(demo::make_surface(scene, k));
  return surfaces;
}

/// Writes pins and colliders, steps, reads what is drawn into the host's own buffers.
inline void host_frame(demo::Scene& scene, std::vector<demo::DrawnSurface>& surfaces) {
  scene.step();
  for (size_t k = 0; k < surfaces.size(); ++k) demo::read_vertices(scene, k, surfaces[k]);
}

}  // namespace pleat::bench
