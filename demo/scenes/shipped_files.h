#pragma once

#include <span>
#include <string_view>

namespace pleat::demo {

/// A file of demo/scenes that was built into the program: see embed.cmake.
struct ShippedFile {
  std::string_view name, bytes;
};

extern const std::span<const ShippedFile> kShippedFiles;

}  // namespace pleat::demo
