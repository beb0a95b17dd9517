#pragma once

#include <filesystem>

#include "demo/pictures.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::demo {

struct RunOptions {
  SceneRequest scene;
  std::filesystem::path out = "out";
  PictureSize size;
  bool render = true;
  std::filesystem::path json;  ///< empty: none
};

/// `pleat run`. After an error neither the folder nor the JSON file has changed. Throws InputError, std::runtime_error.
void run(const pleat_api& api, const RunOptions& options);

}  // namespace pleat::demo
