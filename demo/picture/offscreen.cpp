#include "demo/picture/offscreen.h"

// glcorearb.h (in gl.h) declares OpenGL; these keep osmesa.h from pulling in the old gl.h beside it.
#define __gl_h_
#define GLAPIENTRY
#include <GL/osmesa.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace pleat::demo {
namespace {

GLuint make_framebuffer(const Gl& gl, int width, int height, int samples) {
  GLuint framebuffer = 0;
  std::array<GLuint, 2> buffers{};
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenRenderbuffers(2, buffers.data());
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_SRGB8_ALPHA8, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("OpenGL cannot make a picture of " + std::to_string(width) + "x" + std::to_string(height));
  }
  return framebuffer;
}

}  // namespace

struct Offscreen::Context {
  OSMesaContext handle = nullptr;
  std::array<unsigned char, 4> window{};  // OSMesa wants a buffer of its own; we draw elsewhere

  Context() {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    handle = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!handle) throw std::runtime_error("OSMesa gives no OpenGL 3.3 core context (is Mesa's llvmpipe installed?)");
  }
  ~Context() { OSMesaDestroyContext(handle); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void make_current() {
    if (!OSMesaMakeCurrent(handle, window.data(), GL_UNSIGNED_BYTE, 1, 1)) {
      throw std::runtime_error("OSMesa cannot make its OpenGL context current");
    }
  }
};

Offscreen::Offscreen(int width, int height) : width_(width), height_(height) {
  if (width < 1 || height < 1 || width > kMostDrawn || height > kMostDrawn) {
    throw std::invalid_argument("picture size " + std::to_string(width) + "x" + std::to_string(height) +
                                " is not within 1.." + std::to_string(kMostDrawn));
  }
  context_ = std::make_unique<Context>();
  begin();
#define PLEAT_GL_LOAD(type, name) gl_.name = reinterpret_cast<PFNGL##type##PROC>(OSMesaGetProcAddress("gl" #name));
  PLEAT_GL_ENTRIES(PLEAT_GL_LOAD)
#undef PLEAT_GL_LOAD
  samples_ = make_framebuffer(gl_, width, height, 4);
  resolved_ = make_framebuffer(gl_, width, height, 0);
}

Offscreen::~Offscreen() = default;

void Offscreen::begin() { context_->make_current(); }

void Offscreen::bind_picture() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, samples_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
}

Image Offscreen::read() {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, samples_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_);

  Image image = make_image(width_, height_, 0);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  for (int y = 0; y < height_ / 2; ++y) {  // OpenGL's rows start at the bottom
    std::swap_ranges(image.pixel(0, y), image.pixel(0, y) + 4 * width_, image.pixel(0, height_ - 1 - y));
  }
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  if (const GLenum error = gl_.GetError()) {
    throw std::runtime_error("OpenGL error " + std::to_string(error) + " while drawing");
  }
  return image;
}

}  // namespace pleat::demo
