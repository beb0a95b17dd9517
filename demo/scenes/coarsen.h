#pragma once

#include <cstddef>

#include "demo/scenes/triangle_mesh.h"

namespace pleat::demo {

/// A mesh of at most `vertices` vertices, if it can be had: the shortest edges collapse one by one, so that what is
/// left are triangles of about one size, as cloth wants them. Borders stay borders; texture coordinates are dropped.
///
/// An edge collapses into its middle, or into its end on the border, only where the surface stays a manifold (the link
/// condition: T. Dey, H. Edelsbrunner, S. Guha, D. Nekhayev, Topology preserving edge contraction, 1999) and no
/// triangle turns by more than 60 degrees. Where no edge may, the mesh is left finer than asked for.
TriangleMesh coarsen(const TriangleMesh& mesh, std::size_t vertices);

}  // namespace pleat::demo
