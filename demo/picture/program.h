#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "demo/picture/gl.h"

namespace pleat::demo {

/// A compiled pair of shaders; lives as long as its context. Setters act on the program in use.
class Program {
 public:
  /// `common` stands before both shaders. Errors: std::runtime_error with the compiler's log.
  Program(const Gl& gl, const char* common, const char* vertex, const char* fragment);

  void use() const { gl_->UseProgram(id_); }
  void set(const char* name, float value) const { gl_->Uniform1f(at(name), value); }
  void set(const char* name, int value) const { gl_->Uniform1i(at(name), value); }
  void set(const char* name, float x, float y) const { gl_->Uniform2f(at(name), x, y); }
  void set(const char* name, const Eigen::Vector3f& v) const { gl_->Uniform3f(at(name), v.x(), v.y(), v.z()); }
  void set(const char* name, const Eigen::Matrix4f& m) const { gl_->UniformMatrix4fv(at(name), 1, GL_FALSE, m.data()); }
  /// Red, green and blue of the sRGB colour 0xRRGGBBAA, made linear.
  void set_colour(const char* name, std::uint32_t rgba) const;

 private:
  GLint at(const char* name) const { return gl_->GetUniformLocation(id_, name); }
  const Gl* gl_;
  GLuint id_;
};

}  // namespace pleat::demo
