#pragma once

#include <Eigen/Core>

#include "demo/scenes/triangle_mesh.h"

namespace pleat::demo {

/// An icosahedron whose faces were split in four `level` times, all vertices on the sphere: 20 * 4^level triangles.
TriangleMesh make_icosphere(uint32_t level, const Eigen::Vector3d& center, double radius);

}  // namespace pleat::demo
