// The convex hull of points as a closed triangle mesh, so that boxes and hulls meet cloth the way meshes do.
#pragma once

#include <span>

#include "components/colliders.h"

namespace pleat {

/// A rigid body whose frame is the world's: the hull of `points` (m), outward and counter-clockwise, its local vertices
/// a subset of them in an order of its own. Without triangles where the points lie in a plane, or nearly.
/// A particle is brought back from any depth. Throws std::bad_alloc.
MeshCollider build_hull(std::span<const Vec3> points, std::pmr::memory_resource* memory);

/// The same of a box with these half extents, m, > 0, however thin it is.
MeshCollider build_box(const Vec3& half, std::pmr::memory_resource* memory);

/// Puts a rigid body there at rest.
void place_rigid(MeshCollider& body, const RigidPose& pose);
/// Where it shall be at the end of the next tick.
void move_rigid(MeshCollider& body, const RigidPose& pose);

}  // namespace pleat
