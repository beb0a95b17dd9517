#pragma once

#include <memory>

#include "demo/picture/gl.h"
#include "demo/picture/image.h"

namespace pleat::demo {

/// An OpenGL 3.3 core context without a display, and a 4x multisampled sRGB picture to draw into. The only place that
/// knows the platform's library (OSMesa). A thread may hold several; begin() makes one current.
class Offscreen {
 public:
  /// Errors: std::runtime_error when no context or picture can be had; std::invalid_argument for a size
  /// outside 1..kMostDrawn.
  Offscreen(int width, int height);
  ~Offscreen();

  const Gl& gl() const { return gl_; }
  int width() const { return width_; }
  int height() const { return height_; }

  void begin();         // makes the context current on this thread
  void bind_picture();  // draw calls go to the picture from here on
  Image read();         // the picture, samples averaged in linear light, alpha 255

 private:
  struct Context;
  int width_, height_;
  std::unique_ptr<Context> context_;
  Gl gl_;
  GLuint samples_ = 0, resolved_ = 0;  // framebuffers
};

}  // namespace pleat::demo
