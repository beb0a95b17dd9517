#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pleat::demo {

struct Camera {
  Eigen::Vector3f eye{0, 1, 4};     // m
  Eigen::Vector3f target{0, 1, 0};  // m; the light stands relative to it
  Eigen::Vector3f up{0, 1, 0};
  float fov_y = 0.5f;  // rad, of the whole height
};

/// Unit axes of a camera as columns: right, up, back (against the viewing direction).
/// Errors: std::invalid_argument when eye, target and up do not span a frame.
Eigen::Matrix3f camera_axes(const Camera& camera);

/// World to OpenGL clip space. `near` and `far` in m, `aspect` is width / height.
Eigen::Matrix4f view_projection(const Camera& camera, float aspect, float near, float far);

/// World to OpenGL clip space for parallel light: a cube of half size `radius` m around `centre`, seen against
/// `to_light` (unit).
Eigen::Matrix4f light_projection(const Eigen::Vector3f& to_light, const Eigen::Vector3f& centre, float radius);

/// The closest camera that looks at the box's centre from `direction` (towards the eye, any length) and has all of the
/// box in sight with a margin of a twentieth. Give it the box of a whole clip and the aim never moves.
/// Errors: std::invalid_argument when a number is not finite or the box is inside out.
Camera frame_box(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& direction, float fov_y, float aspect);

}  // namespace pleat::demo
