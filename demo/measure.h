#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "demo/quality/quality.h"
#include "demo/scenes/scene_def.h"
#include "demo/scenes/stage_clock.h"

namespace pleat::demo {

/// What a run of a scene showed, apart from pictures.
struct RunRecord {
  pleat_garment_info garment;
  pleat_cloth_info cloth;
  pleat_stats stats;
  size_t cloths;
  size_t border_edges;  ///< of one drawn cloth
  bool watertight;      ///< the drawn surface is open only where the garment is, and joined edge to edge elsewhere
  bool all_finite;      ///< every drawn vertex of every frame
  Quality quality;
  std::vector<StageClock::Stage> stages;
  uint32_t most_compressed_frame;  ///< 1 is the first; where short edges are shortest, all in all
  Eigen::AlignedBox3d seen;        ///< all particles of all frames, relative to followed() of view.h
};

/// Runs a scene without drawing it, so that the costs are its own.
RunRecord measure(const pleat_api& api, const SceneDef& def);

}  // namespace pleat::demo
