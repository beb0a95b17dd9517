#pragma once

#include "demo/scenes/scene_reader.h"

namespace pleat::demo {

/// `pleat list`: scenes, surfaces, integrators, levels, settings, features.
void list(const pleat_api& api);

/// `pleat explain`: the plan, a line a system.
void explain(const pleat_api& api, const SceneRequest& request);

}  // namespace pleat::demo
