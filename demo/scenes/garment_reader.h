#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "demo/motion/figure.h"
#include "demo/scenes/json_value.h"
#include "demo/scenes/scene_files.h"
#include "demo/scenes/triangle_mesh.h"
#include "engine/pleat.h"

namespace pleat::demo {

struct Garment {
  TriangleMesh mesh;           ///< at rest, world space
  std::vector<uint32_t> pins;  ///< vertices, ascending
};

/// The body that a skirt is cut for, at the moment when it is put on.
struct Wearer {
  const Figure* figure;
  Eigen::Isometry3d hips;
};

/// Reads a scene's `garment`. `wearer` may be null; a `skirt` needs one. Throws InputError.
Garment read_garment(const JsonValue& garment, const SceneFile& file, const pleat_api& api, const Wearer* wearer);

/// Reads a mesh from an OBJ file: {"file", "scale", "up": "y" or "z", "move"}. Throws InputError.
TriangleMesh read_mesh_file(const JsonValue& mesh, const SceneFile& file);

}  // namespace pleat::demo
