#pragma once

#include "demo/picture/camera.h"
#include "demo/picture/gl.h"

namespace pleat::demo {

// Directions towards the lights, unit, fixed to where the viewer stands: the key from above the left shoulder, so that
// folds cast shade; the fill opposite and lower, so that folds on the shaded side can be read.
Eigen::Vector3f key_direction(const Camera& camera);
Eigen::Vector3f fill_direction(const Camera& camera);

/// Depth seen from a light, compared on lookup; nothing outside of it is in shadow. Lives as long as its context.
struct ShadowMap {
  int size;  // texels a side: the fewer, the softer the shadow
  GLuint texture = 0, framebuffer = 0;

  ShadowMap(const Gl& gl, int texels);
};

/// What a shadow map looks at in one frame.
struct LightView {
  Eigen::Matrix4f projection;  // world to clip space
  float texel;                 // m
};

/// A view of the whole box against `to_light`, for a map of `texels` a side.
LightView light_view(const Eigen::Vector3f& to_light, const Eigen::AlignedBox3f& box, int texels);

}  // namespace pleat::demo
