#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/bullet_scene.h"
#include "demo/quality/quality.h"
#include "demo/quality/scene_surface.h"
#include "demo/scenes/scene_def.h"
#include "demo/scenes/stage_clock.h"

namespace pleat::bench {

/// The same scene run by Bullet's soft body in turn with ours: the bare particles, no curved surface.
struct Peer {
  BulletSettings settings;
  demo::Spread frame;  ///< us, as Budget::frame
  demo::Quality quality;
  double ratio_frame;     ///< median over all frames of ours / the peer's time for the same frame
  double ratio_dynamics;  ///< our stages up to the moved particles, as surfaces are not its work / its frame
};

/// What a frame of a scene costs. Times in us; the median is that of the best run, min and p99 are over all runs.
struct Budget {
  uint32_t repeat;
  size_t cloths;
  pleat_cloth_info cloth;
  demo::Spread frame;
  std::vector<std::pair<std::string, demo::Spread>> stages;   ///< groups of systems, see stage_group
  std::vector<std::pair<std::string, demo::Spread>> systems;  ///< one by one
  std::optional<double> pn_smoothing;           ///< median us of the smoothing stages with PN alone, where we do more
  std::optional<double> allocations_per_frame;  ///< after warm-up; absent for runs that are all warm-up
  uint64_t folds_given_up, substeps_given_up, ticks_given_up;  ///< cloths without, for the budget, in the last frame
  uint64_t invisible;                                          ///< cloths out of sight
  demo::Quality quality;
  demo::SceneSurface surface;
  std::optional<Peer> peer;
  std::optional<demo::SceneSurface> pn_surface;  ///< of PN alone over the same coarse motion, where we do more
};

/// The paper's three parts, as stages.
inline constexpr std::array<std::string_view, 3> kIntegrationStages = {"forces", "integration", "stretch"};
inline constexpr std::array<std::string_view, 1> kCollisionStages = {"collision"};
inline constexpr std::array<std::string_view, 5> kSmoothingStages = {"normals", "edge_length", "fold_relaxation",
                                                                     "tessellation", "drawn_normals"};

/// Sum of the medians of these stages, us.
double stage_sum(const std::vector<std::pair<std::string, demo::Spread>>& stages,
                 std::span<const std::string_view> names);

/// The stage that a system of the schedule is counted under; one that stands for itself keeps its name.
std::string stage_group(const std::string& system);

/// Runs the scene `repeat` times for the frame, in turn with the peer where one is asked for, again for the stages
/// (asking the clock costs time), and once each for quality and for the drawn surface.
Budget measure_budget(const pleat_api& api, const demo::SceneDef& def, uint32_t repeat,
                      const std::optional<BulletSettings>& peer);

}  // namespace pleat::bench
