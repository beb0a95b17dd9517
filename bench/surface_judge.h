#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/surface_truth.h"
#include "engine/pleat.h"

namespace pleat::bench {

/// Root mean square of the distances from points (N,3) m to the nearest place of a triangle mesh, m.
double rms_distance(std::span<const float> points, std::span<const float> positions,
                    std::span<const uint32_t> triangles);

struct SurfaceVerdict {
  double rms_mm;              ///< from the truth's points to the drawn surface
  double area_error_percent;  ///< of the drawn surface, against the truth's triangles
  double us;                  ///< normals, edge length control, tessellation and shading normals together; median
};

/// Draws over n x n particles that lie on the truth: with each of `modes` (PLEAT_SURFACE_*) and else by `settings`.
/// Nothing is simulated, so the surface alone is judged. The modes are timed in turn. n - 1 divides kFineSide - 1.
std::vector<SurfaceVerdict> judge(const pleat_api& api, const SurfaceTruth& truth, uint32_t n,
                                  std::span<const uint32_t> modes, const pleat_cloth_settings& settings);

}  // namespace pleat::bench
