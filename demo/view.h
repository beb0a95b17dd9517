#pragma once

#include "demo/measure.h"
#include "demo/picture/frame.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"

namespace pleat::demo {

/// Turns a running scene into what the renderer draws.
class View {
 public:
  /// The camera keeps all that `record` saw of the cloth in sight. `aspect` is width / height.
  View(const Scene& scene, const RunRecord& record, float aspect);

  Frame frame(const Scene& scene);              ///< bodies and the drawn cloths
  Frame bodies(const Scene& scene) const;       ///< bodies alone, the same camera
  Mesh coarse_cloth(const Scene& scene) const;  ///< the first cloth's simulated triangles, their edges in ink

 private:
  Camera camera_;  // at the first pose
  std::vector<Mesh> fixed_;
  std::vector<DrawnSurface> surfaces_;
};

}  // namespace pleat::demo
