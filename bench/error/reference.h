#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "bench/error/rest_scene.h"

namespace pleat::bench {

/// The truth of a rest scene, and the same from a mesh of half as many cells along each side: what of the truth still
/// depends on its mesh is about the difference of the two, or less.
struct Reference {
  std::vector<float> fine, half;  ///< (kFineSide^2, 3) m, evenly spaced in u and v
};

/// Solved by the library itself: springs of 1000 N/m both ways, no strain limit, no inner friction, steps that are
/// short enough for any integrator, drawn to rest by damping; on ever finer grids up to the scene's, each starting from
/// the one before. Both ways of halving, the mesh and the step, are in
/// `ReferenceSolution`.
struct ReferenceSolution {
  Reference reference;
  double motion;    ///< m, the farthest that a particle of the finest grid went in the last quarter second
  double step_rms;  ///< m, how far the surface of the half grid moves when its steps are half as long
};
/// Minutes of work: calls `progress` with the share done. Throws std::runtime_error where the library had to soften
/// the springs, for then it is another material.
ReferenceSolution solve_reference(const pleat_api& api, const RestScene& scene,
                                  const std::function<void(double share)>& progress);

/// As kept in files `NAME.f32` and `NAME_half.f32` of a folder. Throw as read_fine.
Reference read_reference(const std::filesystem::path& folder, const RestScene& scene);
void write_reference(const std::filesystem::path& folder, const RestScene& scene, const Reference& reference);

/// As a mesh to measure with.
demo::TriangleMesh reference_surface(const pleat_api& api, std::span<const float> points);

}  // namespace pleat::bench
