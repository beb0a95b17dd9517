#include "demo/picture/light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pleat::demo {
namespace {

// A direction given to the viewer's right, up, and back from the scene to the viewer; level, however the camera tilts.
Eigen::Vector3f from_viewer(const Camera& camera, float to_right, float up, float back) {
  const Eigen::Vector3f right = camera_axes(camera).col(0);
  return (to_right * right + up * Eigen::Vector3f::UnitY() + back * right.cross(Eigen::Vector3f::UnitY())).normalized();
}

}  // namespace

Eigen::Vector3f key_direction(const Camera& camera) { return from_viewer(camera, -1.1f, 0.9f, 0.2f); }
Eigen::Vector3f fill_direction(const Camera& camera) { return from_viewer(camera, 1.0f, 0.25f, 0.1f); }

ShadowMap::ShadowMap(const Gl& gl, int texels) : size(texels) {
  constexpr std::array<float, 4> kFar{1, 1, 1, 1};
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, kFar.data());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
  gl.DrawBuffer(GL_NONE);
}

LightView light_view(const Eigen::Vector3f& to_light, const Eigen::AlignedBox3f& box, int texels) {
  // The size goes up in coarse steps, so that shadows do not shimmer as the cloth moves. The box's ball fills at most
  // nine tenths, so that the filter never reaches beyond the edge.
  const float radius = std::max(box.diagonal().norm() / 2, 1e-3f) / 0.9f;
  const float stepped = std::exp2(std::ceil(std::log2(radius) * 4) / 4);
  return {light_projection(to_light, box.center(), stepped), 2 * stepped / static_cast<float>(texels)};
}

}  // namespace pleat::demo
