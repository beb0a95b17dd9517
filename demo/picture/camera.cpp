#include "demo/picture/camera.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pleat::demo {
namespace {

// Rigid motion from world to axes placed at origin.
Eigen::Matrix4f view_matrix(const Eigen::Matrix3f& axes, const Eigen::Vector3f& origin) {
  Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
  view.topLeftCorner<3, 3>() = axes.transpose();
  view.topRightCorner<3, 1>() = -(axes.transpose() * origin);
  return view;
}

}  // namespace

Eigen::Matrix3f camera_axes(const Camera& camera) {
  const Eigen::Vector3f back = (camera.eye - camera.target).normalized();
  const Eigen::Vector3f right = camera.up.normalized().cross(back);
  if (!(right.norm() > 1e-6f)) {  // also when something is not finite
    throw std::invalid_argument("camera: eye, target and up do not span a frame");
  }
  Eigen::Matrix3f axes;
  axes.col(0) = right.normalized();
  axes.col(1) = back.cross(axes.col(0));
  axes.col(2) = back;
  return axes;
}

Eigen::Matrix4f view_projection(const Camera& camera, float aspect, float near, float far) {
  const float focal = 1 / std::tan(camera.fov_y / 2);
  Eigen::Matrix4f projection = Eigen::Matrix4f::Zero();
  projection(0, 0) = focal / aspect;
  projection(1, 1) = focal;
  projection(2, 2) = (near + far) / (near - far);
  projection(2, 3) = 2 * near * far / (near - far);
  projection(3, 2) = -1;
  return projection * view_matrix(camera_axes(camera), camera.eye);
}

Eigen::Matrix4f light_projection(const Eigen::Vector3f& to_light, const Eigen::Vector3f& centre, float radius) {
  Eigen::Matrix3f axes;
  axes.col(0) = to_light.unitOrthogonal();
  axes.col(1) = to_light.cross(axes.col(0));
  axes.col(2) = to_light;
  const Eigen::Vector4f scale(1 / radius, 1 / radius, -1 / radius, 1);
  return scale.asDiagonal() * view_matrix(axes, centre);
}

Camera frame_box(const Eigen::AlignedBox3f& box, const Eigen::Vector3f& direction, float fov_y, float aspect) {
  if (!box.min().allFinite() || !box.max().allFinite() || (box.min().array() > box.max().array()).any()) {
    throw std::invalid_argument("camera: the box to frame is empty or not finite");
  }
  Camera camera;
  camera.fov_y = fov_y;
  camera.target = box.center();
  camera.eye = camera.target + direction;
  const Eigen::Matrix3f axes = camera_axes(camera);

  // A corner at (x, y, z) on the camera's axes is in sight from distance z + |x| / tan(fov_x / 2), and so for y.
  const float tan_y = std::tan(fov_y / 2) * 0.95f;
  const float tan_x = tan_y * aspect;
  float distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto type = static_cast<Eigen::AlignedBox3f::CornerType>(corner);
    const Eigen::Vector3f p = axes.transpose() * (box.corner(type) - camera.target);
    distance = std::max({distance, p.z() + std::abs(p.x()) / tan_x, p.z() + std::abs(p.y()) / tan_y});
  }
  camera.eye = camera.target + std::max(distance, 1e-3f) * axes.col(2);
  return camera;
}

}  // namespace pleat::demo
