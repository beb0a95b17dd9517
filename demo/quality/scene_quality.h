#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "demo/quality/quality.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"

namespace pleat::demo {

/// The quality of a running scene, ours or the same one run by others. Every cloth is held against the bodies of its
/// own copy, and the fixed ones.
class SceneQuality {
 public:
  /// Takes the mesh and the bodies that never move from `scene`.
  explicit SceneQuality(const Scene& scene);

  /// Looks at the frame that was just stepped; `surfaces` are its drawn cloths, the first ones of all; none where
  /// only particles are drawn.
  void add_frame(const RunningScene& scene, std::span<const DrawnSurface> surfaces);
  /// Holds the pose for 5 s and then watches the particles for another second. Nothing where no body moves.
  void measure_rest(RunningScene& scene);
  Quality result() const { return meter_.result(); }

 private:
  void add_crossings_of_layers(const RunningScene& scene, std::span<const DrawnSurface> surfaces);
  Bodies bodies_of(const RunningScene& scene, size_t copy) const;

  ClothMesh mesh_;
  Bodies fixed_;
  QualityMeter meter_;
  std::vector<float> particles_;  // scratch
};

/// As frame_budget and `pleat run` write it; what was not measured is left out.
nlohmann::ordered_json to_json(const Quality& quality);

}  // namespace pleat::demo
