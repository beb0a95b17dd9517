#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "demo/scenes/triangle_mesh.h"

namespace pleat::demo {

std::vector<Eigen::Vector3f> box_corners(const Eigen::Vector3f& center, const Eigen::Vector3f& half_extents);

/// The convex hull of a few points, turned and then moved, to draw and to measure: every three points that have all
/// others on one side of their plane. Where more than three lie in one plane, triangles overlap there. O(N^4), N <= 64.
/// Empty where all lie in a plane.
TriangleMesh make_hull(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& position,
                       const Eigen::Quaternionf& rotation);

}  // namespace pleat::demo
