#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "demo/quality/distance.h"

namespace pleat::demo {

/// A closed, outward-facing triangle mesh that tells how deep a point is inside it. On a mesh with holes the sign near
/// a hole means little.
class SolidMesh {
 public:
  /// positions: (V,3) m; triangles: (T,3) indices, T >= 1.
  SolidMesh(std::span<const float> positions, std::span<const uint32_t> triangles);

  /// The surface as seen from a point.
  struct Place {
    double distance;  ///< m; negative inside
    Vector3d normal;  ///< of the nearest triangle, unit length
  };
  Place nearest(const Vector3d& p) const;
  /// Distance from p to the surface, m; negative inside.
  double signed_distance(const Vector3d& p) const { return nearest(p).distance; }

 private:
  struct Box {
    Vector3d low, high;
    double squared_distance(const Vector3d& p) const;
  };
  struct Nearest {
    double squared_distance, facing;
    Vector3d normal;
  };
  void build(size_t node, size_t first, size_t last);
  void search(size_t node, size_t first, size_t last, const Vector3d& p, Nearest& nearest) const;

  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;  // a binary tree in heap order: the children of node i are 2i+1 and 2i+2
};

}  // namespace pleat::demo
