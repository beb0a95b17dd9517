#include "bench/budget.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/counting_new.h"
#include "bench/host_frame.h"
#include "demo/program/progress.h"
#include "demo/quality/scene_quality.h"

namespace pleat::bench {
namespace {

using bench::host_frame;  // and one of a peer below
using demo::DrawnSurface;
using demo::Progress;
using demo::Scene;
using demo::SceneDef;
using demo::SceneQuality;
using demo::Spread;
using demo::StageClock;
using NamedSpread = std::pair<std::string, Spread>;

constexpr uint32_t kWarmUp = 10;  // frames that may still allocate

/// What a host does in a frame with a peer, which draws its bare particles.
void host_frame(BulletScene& scene, std::vector<float>& particles) {
  scene.step();
  for (size_t k = 0; k < scene.copies(); ++k) scene.read_particles(k, particles);
}

struct TimedRun {
  std::vector<double> frames;  // us
  uint64_t allocations = 0;    // after warm-up
};

template <class SceneT, class Drawn>
TimedRun time_frames(SceneT& scene, Drawn& drawn, Progress& progress) {
  TimedRun run;
  run.frames.reserve(scene.def().frames);
  for (uint32_t frame = 0; frame < scene.def().frames; ++frame) {
    scene.pose_next();
    const uint64_t allocations = allocation_count();
    const auto start = std::chrono::steady_clock::now();
    host_frame(scene, drawn);
    const auto end = std::chrono::steady_clock::now();
    if (frame >= kWarmUp) run.allocations += allocation_count() - allocations;
    run.frames.push_back(std::chrono::duration<double, std::micro>(end - start).count());
    progress.step();
  }
  return run;
}

TimedRun time_frames(const pleat_api& api, const SceneDef& def, Progress& progress) {
  Scene scene(api, def);
  std::vector<DrawnSurface> surfaces = make_surfaces(scene);
  return time_frames(scene, surfaces, progress);
}

TimedRun time_frames(const BulletSettings& settings, const SceneDef& def, Progress& progress) {
  BulletScene scene(def, settings);
  std::vector<float> particles;
  return time_frames(scene, particles, progress);
}

std::vector<StageClock::Stage> time_stages(const pleat_api& api, const SceneDef& def, Progress& progress) {
  StageClock clock;
  Scene scene(api, def, StageClock::on_stage, &clock);
  std::vector<DrawnSurface> surfaces = make_surfaces(scene);
  for (uint32_t frame = 0; frame < def.frames; ++frame) {
    scene.pose_next();
    clock.begin_frame();
    host_frame(scene, surfaces);
    clock.end_frame();
    progress.step();
  }
  return clock.stages();
}

/// Adds up the systems of each stage, frame by frame.
std::vector<StageClock::Stage> by_group(const std::vector<StageClock::Stage>& systems) {
  std::vector<StageClock::Stage> groups;
  for (const StageClock::Stage& system : systems) {
    const std::string name = stage_group(system.name);
    auto group = std::ranges::find(groups, name, &StageClock::Stage::name);
    if (group == groups.end()) {
      groups.push_back({name, system.frames});
    } else {
      std::ranges::transform(group->frames, system.frames, group->frames.begin(), std::plus());
    }
  }
  return groups;
}

Spread best_of(const std::vector<std::vector<double>>& runs) {
  std::vector<double> all, medians;
  for (const std::vector<double>& run : runs) {
    all.insert(all.end(), run.begin(), run.end());
    medians.push_back(demo::spread_of(run).median);
  }
  Spread spread = demo::spread_of(std::move(all));
  spread.median = *std::ranges::min_element(medians);
  return spread;
}

using StageRuns = std::vector<std::vector<StageClock::Stage>>;

std::vector<NamedSpread> best_stages(StageRuns runs) {
  demo::align(runs);
  std::vector<NamedSpread> spreads;
  for (size_t s = 0; s < runs[0].size(); ++s) {
    std::vector<std::vector<double>> frames;
    for (const auto& run : runs) frames.push_back(run[s].frames);
    spreads.emplace_back(runs[0][s].name, best_of(frames));
  }
  return spreads;
}

/// Also finds what is known only once the scene has run.
void measure_quality(const pleat_api& api, const SceneDef& def, Progress& progress, Budget& budget) {
  Scene scene(api, def);
  std::vector<DrawnSurface> surfaces = make_surfaces(scene);
  SceneQuality quality(scene);
  for (uint32_t frame = 0; frame < def.frames; ++frame) {
    scene.pose_next();
    host_frame(scene, surfaces);
    quality.add_frame(scene, surfaces);
    progress.step();
  }
  budget.cloths = scene.cloths().size();
  budget.cloth = scene.cloth_info(0);
  budget.folds_given_up = scene.stats().folds_given_up;
  budget.substeps_given_up = scene.stats().substeps_given_up;
  budget.ticks_given_up = scene.stats().ticks_given_up;
  budget.invisible = scene.stats().invisible;
  quality.measure_rest(scene);
  budget.quality = quality.result();
}

demo::Quality peer_quality(const pleat_api& api, const SceneDef& def, const BulletSettings& settings,
                           Progress& progress) {
  const Scene ours(api, def);
  SceneQuality quality(ours);
  BulletScene peer(def, settings);
  for (uint32_t frame = 0; frame < def.frames; ++frame) {
    peer.advance();
    quality.add_frame(peer, {});
    progress.step();
  }
  quality.measure_rest(peer);
  return quality.result();
}

/// Frame by frame, ours over the peer's of the run that came next.
double median_ratio(const std::vector<std::vector<double>>& ours, const std::vector<std::vector<double>>& peer) {
  std::vector<double> ratios;
  for (size_t r = 0; r < ours.size(); ++r) {
    std::ranges::transform(ours[r], peer[r], std::back_inserter(ratios), std::divides());
  }
  return demo::spread_of(std::move(ratios)).median;
}

}  // namespace

std::string stage_group(const std::string& system) {
  using Group = std::pair<const char*, std::vector<std::string_view>>;
  static const std::vector<Group> kGroups = {
      {"forces",
       {"elastic_force", "hinge_bending", "elastic_projection", "edge_damping", "gravity", "air_damping", "air_drag",
        "inner_friction", "slow_force"}},
      {"integration",
       {"implicit_integration", "pin_motion", "euler_integration", "finite_guard", "runge_kutta_integration",
        "velocity_update", "rounding_hold"}},
      {"stretch", {"tether_constraint", "stretch_constraint", "stretch_after_friction", "edge_ways", "coarse_stretch"}},
      {"collision",
       {"collider_motion", "capsule_detection", "mesh_detection", "collision_response", "contact_friction",
        "contact_acceleration", "contact_velocity", "collision_last_word", "mesh_candidates", "capsule_candidates",
        "contact_stick", "body_refit"}},
      {"self", {"self_candidates", "self_detection"}},
      {"layers", {"layer_candidates", "layer_detection"}},
      {"clearance", {"surface_footprint", "surface_capsules", "surface_clearance", "mesh_clearance"}},
      {"normals", {"particle_normals"}},
      {"edge_length", {"fold_sides"}},
  };
  const auto found =
      std::ranges::find_if(kGroups, [&](const Group& group) { return std::ranges::count(group.second, system) != 0; });
  return found == kGroups.end() ? system : found->first;
}

double stage_sum(const std::vector<NamedSpread>& stages, std::span<const std::string_view> names) {
  double sum = 0.0;
  for (const auto& [name, spread] : stages) {
    if (std::ranges::find(names, name) != names.end()) sum += spread.median;
  }
  return sum;
}

Budget measure_budget(const pleat_api& api, const SceneDef& def, uint32_t repeat,
                      const std::optional<BulletSettings>& peer) {
  Budget budget{};
  budget.repeat = repeat;
  const bool folds = def.settings.surface == PLEAT_SURFACE_PAPER || def.settings.surface == PLEAT_SURFACE_PLEAT;
  SceneDef single = def;  // systems are timed in turn
  single.workers = 1;
  SceneDef pn = single;
  pn.settings.surface = PLEAT_SURFACE_PN;
  const uint32_t runs = (folds ? 3 : 2) + (peer ? 1 : 0);  // as many in each round as for quality and surface
  Progress progress("measuring, frame", def.frames * runs * (repeat + 1));

  std::vector<std::vector<double>> frames, peer_frames;
  StageRuns systems, groups, pn_groups;
  uint64_t allocations = 0;
  for (uint32_t r = 0; r < repeat; ++r) {  // in turn, so that a slow moment of the machine meets all alike
    TimedRun run = time_frames(api, def, progress);
    allocations += run.allocations;
    frames.push_back(std::move(run.frames));
    if (peer) peer_frames.push_back(time_frames(*peer, def, progress).frames);
    systems.push_back(time_stages(api, single, progress));
    groups.push_back(by_group(systems.back()));
    if (folds) pn_groups.push_back(by_group(time_stages(api, pn, progress)));
  }
  budget.frame = best_of(frames);
  budget.systems = best_stages(systems);
  budget.stages = best_stages(groups);
  if (def.frames > kWarmUp) budget.allocations_per_frame = double(allocations) / repeat / (def.frames - kWarmUp);
  if (folds) budget.pn_smoothing = stage_sum(best_stages(pn_groups), kSmoothingStages);
  measure_quality(api, def, progress, budget);
  if (peer) {
    const Spread frame = best_of(peer_frames);
    budget.peer = {
        *peer, frame, peer_quality(api, def, *peer, progress), median_ratio(frames, peer_frames),
        (stage_sum(budget.stages, kIntegrationStages) + stage_sum(budget.stages, kCollisionStages)) / frame.median};
  }
  budget.surface = demo::measure_surface(api, def, [&] { progress.step(); });
  if (folds) budget.pn_surface = demo::measure_surface(api, pn, [&] { progress.step(); });
  return budget;
}

}  // namespace pleat::bench
