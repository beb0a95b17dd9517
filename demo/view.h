#pragma once

#include "demo/picture/frame.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"

namespace pleat::demo {

/// Where a camera that moves with the body looks from frame to frame, relative to the first pose: the hips' path,
/// averaged over 0.8 s.
Eigen::Vector3d followed(const SceneDef& def, uint32_t frame);

/// All particles as they are now, relative to followed().
Eigen::AlignedBox3d cloth_box(const Scene& scene);

/// Turns a running scene into what the renderer draws.
class View {
 public:
  /// The camera keeps `box`, relative to followed(), in sight. `aspect` is width / height.
  View(const Scene& scene, const Eigen::AlignedBox3d& box, float aspect);

  Frame frame(const Scene& scene);         ///< bodies and the drawn cloths
  Frame bodies(const Scene& scene) const;  ///< bodies alone, the same camera
  Frame coarse(const Scene& scene) const;  ///< bodies and the cloths' simulated triangles, their edges in ink

 private:
  Camera camera_;  // at the first pose
  std::vector<Mesh> fixed_;
  std::vector<DrawnSurface> surfaces_;
};

}  // namespace pleat::demo
