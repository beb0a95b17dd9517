#pragma once

#include <functional>
#include <optional>

#include "demo/quality/surface_motion.h"
#include "demo/scenes/scene_def.h"

namespace pleat::demo {

/// The drawn surface of a scene's first cloth.
struct SceneSurface {
  SurfaceMotion moving;                  ///< in the frames of the scene
  std::optional<SurfaceMotion> resting;  ///< in 2 s from 1 s after them, with the body held; absent where none moves
};

/// What a scene's first cloth is made of. Which drawn vertices lie on a coarse edge shows where the garment is drawn
/// flat, as it was cut. At rest it is drawn with PN triangles, for round garments are round at rest. Throws as Scene.
SurfaceMesh surface_mesh(const pleat_api& api, const SceneDef& def);

/// Runs the scene and calls `step` after each of its frames. Throws as Scene, and as `step`.
SceneSurface measure_surface(const pleat_api& api, const SceneDef& def, const std::function<void()>& step);

}  // namespace pleat::demo
