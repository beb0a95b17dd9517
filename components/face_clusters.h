// Faces that lie together, for what asks about several of them at once.
#pragma once

#include "components/garment.h"

namespace pleat {

/// The most faces of a cluster.
inline constexpr std::uint32_t kFacesPerCluster = 8;

/// Parts the faces of a garment at rest, again and again in the middle of their longest extent, until few are left in
/// each part: fills in clustered_faces and cluster_end. Cost: O(F log F). Throws std::bad_alloc.
void find_face_clusters(Garment& garment);

}  // namespace pleat
