#pragma once

#include <optional>
#include <string>
#include <vector>

#include "demo/scenes/scene_def.h"

namespace pleat::demo {

/// A scene and what the user wants different about it.
struct SceneRequest {
  std::string scene = "kick";  ///< a shipped scene or the path of a JSON file, with `:N` for its size
  std::string clip;            ///< BVH file in place of the scene's; empty: the scene's
  std::optional<double> rate;  ///< frames a second
  std::optional<uint32_t> frames;
  std::vector<std::string> settings;  ///< `key=value`, fields of pleat_cloth_settings
  double speed = 1.0;                 ///< how many times as fast the scene's motion goes, from frame 0 on
};

/// Reads a scene file (its format: README.md here). Throws InputError that names file and key, or the option.
SceneDef load_scene(const pleat_api& api, const SceneRequest& request);

/// The `description` of a shipped scene, one line.
std::string scene_description(const std::string& scene);

}  // namespace pleat::demo
