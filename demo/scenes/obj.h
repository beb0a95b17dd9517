#pragma once

#include <istream>
#include <string>

#include "demo/scenes/triangle_mesh.h"

namespace pleat::demo {

/// Reads the vertices and faces of a Wavefront OBJ; polygons become fans, all groups one mesh, other lines are left
/// out. A vertex that faces use with different texture coordinates keeps the first: splitting it would cut the cloth.
/// `name` stands for the file in messages. Throws InputError, naming the line, for a bad or non-finite number, an index
/// out of range, a face without three corners, no face at all, or more than PLEAT_MAX_PARTICLES, PLEAT_MAX_TRIANGLES.
TriangleMesh read_obj(std::istream& stream, const std::string& name);

/// The same from a file.
TriangleMesh load_obj(const std::string& path);

}  // namespace pleat::demo
