#include "demo/quality/solid_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pleat::demo {
namespace {

constexpr size_t kLeafTriangles = 4;

Vector3d vertex(std::span<const float> positions, uint32_t index) {
  return {positions[3 * index], positions[3 * index + 1], positions[3 * index + 2]};
}

}  // namespace

SolidMesh::SolidMesh(std::span<const float> positions, std::span<const uint32_t> triangles) {
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    triangles_.push_back(
        {vertex(positions, triangles[t]), vertex(positions, triangles[t + 1]), vertex(positions, triangles[t + 2])});
  }
  boxes_.resize(2 * std::bit_ceil(triangles_.size()));
  build(0, 0, triangles_.size());
}

double SolidMesh::Box::squared_distance(const Vector3d& p) const {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

void SolidMesh::build(size_t node, size_t first, size_t last) {
  Box box{triangles_[first].a, triangles_[first].a};
  for (size_t t = first; t < last; ++t) {
    const auto& [a, b, c] = triangles_[t];
    box.low = box.low.cwiseMin(a).cwiseMin(b).cwiseMin(c);
    box.high = box.high.cwiseMax(a).cwiseMax(b).cwiseMax(c);
  }
  boxes_[node] = box;
  if (last - first <= kLeafTriangles) return;
  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const auto begin = triangles_.begin();
  const size_t middle = (first + last) / 2;
  std::nth_element(begin + ptrdiff_t(first), begin + ptrdiff_t(middle), begin + ptrdiff_t(last),
                   [axis](const Triangle& s, const Triangle& t) {
                     return s.a[axis] + s.b[axis] + s.c[axis] < t.a[axis] + t.b[axis] + t.c[axis];
                   });
  build(2 * node + 1, first, middle);
  build(2 * node + 2, middle, last);
}

void SolidMesh::search(size_t node, size_t first, size_t last, const Vector3d& p, Nearest& nearest) const {
  // A little slack, so that all triangles around the nearest edge or corner are seen: they are equally near.
  const double reach = nearest.squared_distance * (1.0 + 1e-9);
  if (boxes_[node].squared_distance(p) > reach) return;
  if (last - first > kLeafTriangles) {
    const size_t middle = (first + last) / 2, left = 2 * node + 1, right = 2 * node + 2;
    if (boxes_[left].squared_distance(p) <= boxes_[right].squared_distance(p)) {
      search(left, first, middle, p, nearest);
      search(right, middle, last, p, nearest);
    } else {
      search(right, middle, last, p, nearest);
      search(left, first, middle, p, nearest);
    }
    return;
  }
  for (size_t t = first; t < last; ++t) {
    const Triangle& triangle = triangles_[t];
    const Vector3d away = p - nearest_on_triangle(p, triangle);
    const double d2 = away.squaredNorm();
    if (d2 > nearest.squared_distance * (1.0 + 1e-9)) continue;
    const Vector3d normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a).normalized();
    const double facing = away.dot(normal);
    // Of equally near triangles the one that faces p most squarely knows the side.
    const bool tie = d2 >= nearest.squared_distance * (1.0 - 1e-9);
    if (!tie || std::abs(facing) > std::abs(nearest.facing)) {
      nearest.facing = facing;
      nearest.normal = normal;
    }
    nearest.squared_distance = std::min(nearest.squared_distance, d2);
  }
}

SolidMesh::Place SolidMesh::nearest(const Vector3d& p) const {
  Nearest nearest{std::numeric_limits<double>::max(), 0.0, Vector3d::Zero()};
  search(0, 0, triangles_.size(), p, nearest);
  return {std::copysign(std::sqrt(nearest.squared_distance), nearest.facing), nearest.normal};
}

}  // namespace pleat::demo
