#include "demo/quality/crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pleat::demo {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

Vector3d point(std::span<const float> positions, uint32_t index) {
  return {positions[3 * index], positions[3 * index + 1], positions[3 * index + 2]};
}

std::vector<std::pair<uint32_t, uint32_t>> edges_of(std::span<const uint32_t> triangles) {
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) edges.push_back(std::minmax({triangles[t + k], triangles[t + (k + 1) % 3]}));
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

struct Face {
  AlignedBox3d box;
  const uint32_t* corner;
};

/// How far the nearer end of pq is beyond triangle abc; 0 where they do not cross.
double depth_through(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  const double above = normal.dot(p - a), below = normal.dot(q - a);
  if (!(above * below < 0.0)) return 0.0;
  const Vector3d at = p + (q - p) * (above / (above - below));
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    if ((to - from).cross(at - from).dot(normal) <= 0.0) return 0.0;
  }
  return std::min(std::abs(above), std::abs(below));
}

}  // namespace

Crossings find_crossings(std::span<const float> positions, std::span<const uint32_t> triangles) {
  std::vector<Face> faces;
  AlignedBox3d whole;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    Face face{{}, &triangles[t]};
    for (size_t k = 0; k < 3; ++k) face.box.extend(point(positions, face.corner[k]));
    whole.extend(face.box);
    faces.push_back(face);
  }
  // Swept along the axis that the mesh is longest in, where the fewest faces are side by side.
  Eigen::Index axis = 0;
  if (!faces.empty()) whole.sizes().maxCoeff(&axis);
  double widest = 0.0;
  for (const Face& face : faces) widest = std::max(widest, face.box.sizes()[axis]);
  const auto low = [axis](const Face& face) { return face.box.min()[axis]; };
  std::ranges::sort(faces, {}, low);

  Crossings found;
  for (const auto& [i, j] : edges_of(triangles)) {
    const Vector3d p = point(positions, i), q = point(positions, j);
    AlignedBox3d box(p);
    box.extend(q);
    const auto first = std::ranges::lower_bound(faces, box.min()[axis] - widest, {}, low);
    for (auto face = first; face != faces.end() && low(*face) <= box.max()[axis]; ++face) {
      const auto [a, b, c] = std::array{face->corner[0], face->corner[1], face->corner[2]};
      if (!face->box.intersects(box) || i == a || i == b || i == c || j == a || j == b || j == c) continue;
      const double depth = depth_through(p, q, point(positions, a), point(positions, b), point(positions, c));
      if (depth == 0.0) continue;
      ++found.count;
      found.deepest = std::max(found.deepest, depth);
    }
  }
  return found;
}

}  // namespace pleat::demo
