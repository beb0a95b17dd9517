#include "bench/error/reference.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "bench/bare_springs.h"
#include "bench/fine_square.h"
#include "bench/metrics/surface_distance.h"
#include "demo/scenes/scene.h"

namespace pleat::bench {
namespace {

constexpr Grid kKept = {kFineSide, kFineSide};

/// A grid, and how long it comes to rest.
struct Level {
  Grid grid;
  double seconds;
};

/// Coarse to fine; the last but one is the half grid.
std::vector<Level> levels(const RestScene& scene) {
  std::vector<Level> all;
  double seconds = 1.5;
  for (uint32_t cut = 1; cut <= 8; cut *= 2) {
    all.push_back({{(scene.fine.rows - 1) / cut + 1, (scene.fine.columns - 1) / cut + 1, scene.fine.pattern}, seconds});
    seconds *= 2.0;
  }
  std::ranges::reverse(all);
  return all;
}

pleat_cloth_settings fine_settings(const pleat_api& api, const RestScene& scene) {
  pleat_cloth_settings s = rest_settings(api, scene);
  use_bare_springs(s, kSpring, kMostSubsteps);
  damp_to_rest(s);
  return s;
}

struct Rest {
  std::vector<float> positions;
  double motion;  ///< m, in the last quarter second
};

Rest relaxed(const pleat_api& api, const RestScene& scene, const Level& level, double substep,
             const std::vector<float>& start, const std::function<void(double share)>& progress) {
  demo::Scene run(api,
                  rest_scene_def(api, scene, level.grid, fine_settings(api, scene), 1.0 / (kMostSubsteps * substep)));
  run.check(api.cloth_write_particles(run.world(), run.cloths()[0], start.data(), nullptr, level.grid.particles()),
            "start");
  const auto ticks = uint32_t(level.seconds * run.def().rate), quarter = uint32_t(0.25 * run.def().rate);
  std::vector<float> before;
  Rest rest{{}, 0.0};
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    if (tick == ticks - quarter) run.read_particles(0, before);
    run.advance();
    progress(double(tick) / ticks);
  }
  pleat_stats stats{};
  stats.size = sizeof stats;
  run.check(api.world_stats(run.world(), &stats), "stats");
  if (stats.stiffness_lowered > 0) throw std::runtime_error(run.def().name + ": the reference's steps are too long");
  run.read_particles(0, rest.positions);
  rest.motion = largest_motion(before, rest.positions);
  return rest;
}

}  // namespace

ReferenceSolution solve_reference(const pleat_api& api, const RestScene& scene,
                                  const std::function<void(double share)>& progress) {
  const std::vector<Level> all = levels(scene);
  const auto substep = [&](Grid grid) { return stable_substep(api, scene, grid); };
  std::vector<float> positions = start_positions(scene, all.front().grid);
  ReferenceSolution solution{};
  double done = 0.0;
  for (size_t i = 0; i < all.size(); ++i) {
    const double work = i + 1 == all.size() ? 0.6 : 0.4 / double(all.size());
    const Rest rest = relaxed(api, scene, all[i], substep(all[i].grid), positions,
                              [&](double share) { progress(done + work * share); });
    done += work;
    const std::vector<float> kept = resampled(rest.positions, all[i].grid, kKept);
    if (i + 2 == all.size()) {
      solution.reference.half = kept;
      const Rest again = relaxed(api, scene, {all[i].grid, 1.0}, 0.5 * substep(all[i].grid), rest.positions,
                                 [&](double) { progress(done); });
      solution.step_rms = surface_distance(reference_surface(api, kept),
                                           reference_surface(api, resampled(again.positions, all[i].grid, kKept)))
                              .rms;
    }
    if (i + 1 == all.size()) {
      solution.reference.fine = kept;
      solution.motion = rest.motion;
    } else {
      positions = resampled(rest.positions, all[i].grid, all[i + 1].grid);
    }
  }
  return solution;
}

Reference read_reference(const std::filesystem::path& folder, const RestScene& scene) {
  const std::string name(scene.name);
  return {read_fine(folder, name), read_fine(folder, name + "_half")};
}

void write_reference(const std::filesystem::path& folder, const RestScene& scene, const Reference& reference) {
  const std::string name(scene.name);
  write_fine(folder, name, reference.fine);
  write_fine(folder, name + "_half", reference.half);
}

demo::TriangleMesh reference_surface(const pleat_api& api, std::span<const float> points) {
  demo::TriangleMesh mesh;
  mesh.positions.assign(points.begin(), points.end());
  mesh.triangles = grid_triangles(api, kKept);
  return mesh;
}

}  // namespace pleat::bench
