#pragma once

#include <memory>

#include "demo/picture/frame.h"
#include "demo/picture/image.h"

namespace pleat::demo {

/// Draws frames of one size in software, without a display: a technical illustration of cloth, bodies and sticks, lit
/// by a key light over the viewer's left shoulder, with soft shadows, on a light floor.
class Renderer {
 public:
  /// Errors: std::runtime_error when OpenGL cannot be had; std::invalid_argument for a size outside 1..kMostDrawn.
  Renderer(int width, int height);
  ~Renderer();

  /// Errors: as validate(frame), before anything is drawn.
  Image draw(const Frame& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pleat::demo
