#include "demo/scenes/icosphere.h"

#include <map>
#include <numbers>
#include <utility>

namespace pleat::demo {

TriangleMesh make_icosphere(uint32_t level, const Eigen::Vector3d& center, double radius) {
  const double g = std::numbers::phi;
  std::vector<Eigen::Vector3d> points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Eigen::Vector3d& point : points) point.normalize();
  std::vector<uint32_t> triangles = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                     4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                     6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  for (uint32_t i = 0; i < level; ++i) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> midpoints;
    const auto midpoint = [&](uint32_t a, uint32_t b) {
      const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), uint32_t(points.size()));
      if (is_new) points.push_back((points[a] + points[b]).normalized());
      return entry->second;
    };
    std::vector<uint32_t> finer;
    for (size_t t = 0; t < triangles.size(); t += 3) {
      const uint32_t a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
      const uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
    }
    triangles = std::move(finer);
  }
  TriangleMesh mesh;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3f p = (center + radius * point).cast<float>();
    mesh.positions.insert(mesh.positions.end(), {p.x(), p.y(), p.z()});
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace pleat::demo
