#pragma once

#include "demo/picture/frame.h"

namespace pleat::demo {

/// A capsule's surface as triangles.
Mesh capsule_mesh(const Capsule& capsule);

/// Each edge of the mesh once, in its wire colour.
std::vector<Stick> wire_sticks(const Mesh& mesh);

}  // namespace pleat::demo
