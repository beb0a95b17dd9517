#pragma once

#include "demo/scenes/triangle_mesh.h"

namespace pleat::demo {

/// Makes the edges of a coarsened garment as long as the cloth that lies along them. Vertices first move to the nearest
/// point of the fine surface, those on the border to the fine border; then each edge is measured there, not straight
/// but along the surface; then the vertices move off again until the edges have these lengths. Else six chords around a
/// sleeve would be a twentieth shorter than the sleeve.
/// Cost: O(edges of the coarse mesh times triangles of the fine one).
void cut_to_length(const TriangleMesh& fine, TriangleMesh& coarse);

}  // namespace pleat::demo
