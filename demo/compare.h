#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "demo/pictures.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::demo {

struct CompareOptions {
  SceneRequest scene;
  std::vector<std::string> rows;               ///< settings of each row, `key=value` joined by commas
  uint32_t first = 1, every = 1, columns = 6;  ///< frames shown; 1 is the first
  bool close_up = false;  ///< look closely at where the first two rows differ most, in the frame shown where they do
  PictureSize size{640, 640};  ///< of a cell, pixels
  std::filesystem::path out = "compare.png";
};

/// `pleat compare`: the same scene under different settings, a row of pictures for each, frame under frame and seen
/// by the same camera. Throws InputError, std::runtime_error.
void compare(const pleat_api& api, const CompareOptions& options);

}  // namespace pleat::demo
