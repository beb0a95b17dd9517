#include "bench/error/dominant.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/error/field.h"
#include "bench/fine_square.h"
#include "bench/metrics/surface_distance.h"

namespace pleat::bench {
namespace {

const Drawing kPleat = {"pleat", PLEAT_SURFACE_PLEAT, PLEAT_LEVEL_FAN};

/// How far what is drawn comes to rest from the truth, m.
double error_of(const pleat_api& api, const RestScene& scene, const Dynamics& dynamics,
                const demo::TriangleMesh& truth) {
  Contestant contestant(api, scene, dynamics);
  settle(contestant);
  return surface_distance(contestant.surface(), truth).rms;
}

/// The truth, moved at each place by how far the particles around it are off.
demo::TriangleMesh moved_truth(const pleat_api& api, const Reference& reference, Grid grid,
                               const std::vector<float>& particles) {
  constexpr Grid kKept = {kFineSide, kFineSide};
  std::vector<float> off = resampled(reference.fine, kKept, grid);
  std::ranges::transform(particles, off, off.begin(), std::minus());
  demo::TriangleMesh mesh = reference_surface(api, reference.fine);
  std::ranges::transform(mesh.positions, resampled(off, grid, kKept), mesh.positions.begin(), std::plus());
  return mesh;
}

}  // namespace

Blame blame_parts(const pleat_api& api, const RestScene& scene, const pleat_cloth_settings& settings,
                  const Reference& reference, Grid grid) {
  const demo::TriangleMesh truth = reference_surface(api, reference.fine);
  const Dynamics usual{"default", grid, settings, {}};
  Contestant contestant(api, scene, usual);
  settle(contestant);
  Blame blame{grid, surface_distance(contestant.surface(), truth).rms, {}};
  const auto add = [&](const char* part, double rms) { blame.swaps.push_back({part, rms}); };

  add("surface", surface_distance(moved_truth(api, reference, grid, contestant.particles()), truth).rms);
  contestant.place(resampled(reference.fine, {kFineSide, kFineSide}, grid));
  add("dynamics", surface_distance(contestant.surface(), truth).rms);
  add("springs", error_of(api, scene, explicit_springs(api, scene, grid, usual.settings), truth));
  Dynamics other = usual;
  other.settings.substeps = 64;
  add("time step", error_of(api, scene, other, truth));
  other = usual;
  other.settings.inner_friction = 0.0f;
  add("threads", error_of(api, scene, other, truth));
  if (scene.body) add("contact", error_of(api, held_on_body(scene), usual, truth));
  return blame;
}

void print_blame(const RestScene& scene, const std::vector<Blame>& of_grids) {
  std::printf("\n%s: %s\n  RMS mm with one part perfect   as is", std::string(scene.name).c_str(),
              std::string(scene.title).c_str());
  for (const Swap& swap : of_grids.front().swaps) std::printf("%11s", swap.part.c_str());
  std::printf("\n");
  for (const Blame& blame : of_grids) {
    const auto best = std::ranges::min_element(blame.swaps, {}, &Swap::rms);
    std::printf("  %4u particles %21.2f", blame.grid.particles(), 1e3 * blame.rms);
    for (const Swap& swap : blame.swaps) std::printf("%11.2f", 1e3 * swap.rms);
    std::printf("   most: %s\n", best->part.c_str());
  }
}

nlohmann::ordered_json blame_json(const std::vector<Blame>& of_grids) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Blame& blame : of_grids) {
    nlohmann::ordered_json swaps;
    for (const Swap& swap : blame.swaps) swaps[swap.part] = 1e3 * swap.rms;
    rows.push_back({{"particles", blame.grid.particles()}, {"rms_mm", 1e3 * blame.rms}, {"swapped_rms_mm", swaps}});
  }
  return rows;
}

}  // namespace pleat::bench
