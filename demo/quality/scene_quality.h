#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "demo/quality/quality.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"

namespace pleat::demo {

/// The quality of a running scene. Every cloth is held against the bodies of its own copy, and the fixed ones.
class SceneQuality {
 public:
  explicit SceneQuality(const Scene& scene);

  /// Looks at the frame that was just stepped; `surfaces` are its drawn cloths.
  void add_frame(const Scene& scene, std::span<const DrawnSurface> surfaces);
  /// Holds the pose for 5 s and then watches the particles for another second. Nothing where no body moves.
  void measure_rest(Scene& scene);
  Quality result() const { return meter_.result(); }

 private:
  Bodies bodies_of(const Scene& scene, size_t copy) const;

  ClothMesh mesh_;
  Bodies fixed_;
  QualityMeter meter_;
  std::vector<float> particles_;  // scratch
};

/// As frame_budget and `pleat run` write it; what was not measured is left out.
nlohmann::ordered_json to_json(const Quality& quality);

}  // namespace pleat::demo
