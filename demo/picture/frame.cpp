#include "demo/picture/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace pleat::demo {
namespace {

[[noreturn]] void refuse(const std::string& what, std::size_t index, const std::string& why) {
  throw std::invalid_argument("picture: " + what + " " + std::to_string(index) + ": " + why);
}

void validate_mesh(const Mesh& mesh, std::size_t number) {
  if (mesh.vertices.size() % 6 != 0) {
    refuse("mesh", number, std::to_string(mesh.vertices.size()) + " vertex floats are not a multiple of 6");
  }
  if (mesh.indices.size() % 3 != 0) {
    refuse("mesh", number, std::to_string(mesh.indices.size()) + " indices are not a multiple of 3");
  }
  const std::size_t count = mesh.vertices.size() / 6;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!std::isfinite(mesh.vertices[i])) refuse("mesh", number, "vertex " + std::to_string(i / 6) + " is not finite");
  }
  for (const std::uint32_t index : mesh.indices) {
    if (index >= count) {
      refuse("mesh", number, "index " + std::to_string(index) + " of " + std::to_string(count) + " vertices");
    }
  }
}

}  // namespace

void validate(const Frame& frame) {
  camera_axes(frame.camera);
  const float fov = frame.camera.fov_y;
  if (!(fov > 0 && fov < std::numbers::pi_v<float>)) {
    throw std::invalid_argument("picture: field of view " + std::to_string(fov) + " is not within 0..pi");
  }
  if (frame.ground && !std::isfinite(*frame.ground)) throw std::invalid_argument("picture: the ground is not finite");
  for (std::size_t i = 0; i < frame.meshes.size(); ++i) validate_mesh(frame.meshes[i], i);
  for (std::size_t i = 0; i < frame.capsules.size(); ++i) {
    const Capsule& capsule = frame.capsules[i];
    if (!capsule.a.allFinite() || !capsule.b.allFinite()) refuse("capsule", i, "an end is not finite");
    if (!(capsule.radius >= 0) || !std::isfinite(capsule.radius)) {
      refuse("capsule", i, "radius " + std::to_string(capsule.radius));
    }
  }
  for (std::size_t i = 0; i < frame.sticks.size(); ++i) {
    const Stick& stick = frame.sticks[i];
    if (!stick.a.allFinite() || !stick.b.allFinite()) refuse("stick", i, "an end is not finite");
    if (!(stick.width > 0) || !std::isfinite(stick.width)) refuse("stick", i, "width " + std::to_string(stick.width));
  }
}

Eigen::AlignedBox3f bounds(const Frame& frame) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : frame.meshes) {
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 6) {
      box.extend(Eigen::Map<const Eigen::Vector3f>(&mesh.vertices[i]));
    }
  }
  for (const Capsule& capsule : frame.capsules) {
    for (const Eigen::Vector3f& end : {capsule.a, capsule.b}) {
      const float radius = capsule.radius + std::max(capsule.taper, 0.0f);
      box.extend((end.array() - radius).matrix());
      box.extend((end.array() + radius).matrix());
    }
  }
  return box;
}

}  // namespace pleat::demo
