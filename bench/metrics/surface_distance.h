#pragma once

#include <cstddef>
#include <cstdint>

#include "demo/scenes/triangle_mesh.h"

namespace pleat::bench {

/// How far two surfaces lie apart, seen from each in turn: what one has and the other lacks counts too.
struct SurfaceDistance {
  double rms;             ///< m, to the nearest place of the other, over the samples of both
  double hausdorff;       ///< m, the greatest of these distances
  double normal_rms_deg;  ///< between the normals at a sample and at the nearest place of the other
};

/// Over area-uniform samples of each: P. Cignoni, C. Rocchini, R. Scopigno, "Metro: measuring error on simplified
/// surfaces", 1998. Neither may be without area.
SurfaceDistance surface_distance(const demo::TriangleMesh& a, const demo::TriangleMesh& b, size_t samples = 10000,
                                 uint32_t seed = 1);

}  // namespace pleat::bench
