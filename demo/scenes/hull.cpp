#include "demo/scenes/hull.h"

#include <algorithm>

namespace pleat::demo {

using Eigen::Vector3f;

std::vector<Vector3f> box_corners(const Vector3f& center, const Vector3f& half_extents) {
  std::vector<Vector3f> corners;
  for (unsigned k = 0; k < 8; ++k) {
    const Vector3f sign(k & 1 ? 1.0f : -1.0f, k & 2 ? 1.0f : -1.0f, k & 4 ? 1.0f : -1.0f);
    corners.push_back(center + sign.cwiseProduct(half_extents));
  }
  return corners;
}

TriangleMesh make_hull(const std::vector<Vector3f>& points, const Vector3f& position,
                       const Eigen::Quaternionf& rotation) {
  TriangleMesh mesh;
  Eigen::AlignedBox3f box;
  for (const Vector3f& p : points) {
    box.extend(p);
    const Vector3f placed = position + rotation * p;
    mesh.positions.insert(mesh.positions.end(), placed.begin(), placed.end());
  }
  const float flat = 1e-5f * box.diagonal().norm();
  const uint32_t count = uint32_t(points.size());
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t j = i + 1; j < count; ++j) {
      for (uint32_t k = j + 1; k < count; ++k) {
        const Vector3f area = (points[j] - points[i]).cross(points[k] - points[i]);
        if (area.norm() < flat * flat) continue;
        const Vector3f normal = area.normalized();
        float least = 0.0f, most = 0.0f;
        for (const Vector3f& p : points) {
          const float height = normal.dot(p - points[i]);
          least = std::min(least, height);
          most = std::max(most, height);
        }
        if (most <= flat && least < -flat) mesh.triangles.insert(mesh.triangles.end(), {i, j, k});
        if (least >= -flat && most > flat) mesh.triangles.insert(mesh.triangles.end(), {i, k, j});
      }
    }
  }
  return mesh;
}

}  // namespace pleat::demo
