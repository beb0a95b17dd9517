// Creases: edges across which the surface is not smooth.
#pragma once

#include "components/garment.h"

namespace pleat {

/// Fills what `garment` knows of creases and normals. A crease is an inner edge that `seams` (particle pairs) names, or
/// whose faces are turned against each other by more than `crease_angle`, rad, at rest. Creases part the faces around
/// a particle where at least two of them meet, or one meets the border; a crease that ends in the middle of the cloth
/// fades out there. Needs faces, edges and hinges. Throws std::bad_alloc.
void find_creases(std::span<const std::array<std::uint32_t, 2>> seams, float crease_angle, Garment& garment);

/// Of sums of face normals (N), each face added at its face_normal: adds the parts of a particle to its own, and makes
/// those of the creases' ends.
void complete_normals(const Garment& garment, Vec3View normal);

}  // namespace pleat
