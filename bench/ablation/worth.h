#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/ablation/parts.h"

namespace pleat::bench {

/// What can be wrong with a cloth. What was not measured is absent.
struct Flaws {
  double stretch_percent;           ///< the largest elongation of an edge in any frame
  std::optional<double> inside_mm;  ///< the deepest point of particles, triangles or drawn triangles in a body
  double length_percent;            ///< coarse edges as drawn against the same at rest, RMS over edges and frames
  std::optional<double> crossings;  ///< coarse edges through triangles of the cloth itself, a frame
  std::optional<double> jitter_mm;  ///< as frame_budget's rest_jitter_mm, where what follows the scene is watched
};

/// What a part is worth to a scene.
struct Worth {
  Ablation ablation;
  double saved_us;      ///< a frame, where it is left out
  Flaws with, without;  ///< as far as the part goes
  double apart_mm;      ///< RMS, between what is drawn in the last frame with and without it
  double turned_deg;    ///< the same of the normals
};

struct SceneWorth {
  std::string scene;
  uint32_t particles;
  uint32_t rounds;
  double frame_us;  ///< of the scene as it is
  Flaws flaws;      ///< the same
  std::vector<Worth> parts;
};

/// How many times measure_worth calls `step`.
uint32_t worth_steps(uint32_t rounds);

/// Runs the scene as it is and each variant, frame by frame in turn, `rounds` times. A frame's time is the least of the
/// rounds; a scene's is the mean over its frames, for some parts only some frames need. With `rest`, what the cloth
/// does in the six seconds after the scene is watched too. Throws as Scene.
SceneWorth measure_worth(const pleat_api& api, const demo::SceneDef& scene, uint32_t rounds, bool rest,
                         const std::function<void()>& step);

void print_worth(const SceneWorth& worth);
nlohmann::ordered_json worth_json(const SceneWorth& worth);

}  // namespace pleat::bench
