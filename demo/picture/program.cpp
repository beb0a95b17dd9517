#include "demo/picture/program.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pleat::demo {

Program::Program(const Gl& gl, const char* common, const char* vertex, const char* fragment)
    : gl_(&gl), id_(gl.CreateProgram()) {
  for (const auto& [type, body] : {std::pair{GLenum{GL_VERTEX_SHADER}, vertex}, {GL_FRAGMENT_SHADER, fragment}}) {
    const std::array<const char*, 3> text{"#version 330 core\n", common, body};
    const GLuint shader = gl.CreateShader(type);
    gl.ShaderSource(shader, static_cast<GLsizei>(text.size()), text.data(), nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(id_, shader);
  }
  gl.LinkProgram(id_);
  GLint linked = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (!linked) {
    std::array<char, 2000> log{};
    gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error(std::string("OpenGL refuses a shader: ") + log.data());
  }
}

void Program::set_colour(const char* name, std::uint32_t rgba) const {
  const auto channel = [rgba](int shift) {
    const float srgb = static_cast<float>((rgba >> shift) & 255) / 255;
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
  };
  set(name, Eigen::Vector3f(channel(24), channel(16), channel(8)));
}

}  // namespace pleat::demo
