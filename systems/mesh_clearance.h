// Which side of the mesh bodies (boxes and hulls too) the drawn surface has to stay on.
//
// As with capsules (surface_clearance.h) the flat footprint of a drawn triangle is outside, and where it and a triangle
// of the body come closest, the direction between them separates the two: the drawn vertices have to stay beyond the
// plane square to it, and then the whole drawn triangle does. Of a body's triangles only those count whose closest
// point is one of the body too:
//
//      footprint  A---B                The direction from the left triangle leans over the right one, which would push
//                / |                   the surface sideways along a flat body; but its closest point is not the body's:
//   body  ======+==+======             the right triangle goes on closer from there. So only the upright one is kept.
//
// A footprint that has come through the surface by no more than the clearance is brought out the nearest way; contact
// sees to what is deeper. Of bodies thinner than the surface bulges only the near side counts.
#pragma once

#include "components/colliders.h"
#include "components/garment.h"
#include "components/near_triangles.h"
#include "components/tessellation_pattern.h"
#include "systems/clearance_list.h"
#include "systems/collision_bodies.h"

namespace pleat {

/// Adds the planes that keep drawn triangles at least `clearance` from mesh bodies. None is added where the surface
/// cannot have fallen behind it, from how far its vertices are from their places on the coarse triangle.
/// Reads:  garment faces; pattern; footprint (V) m, the drawn vertices on the flat coarse triangles; meshes; bodies
/// Writes: near (scratch); planes, and drawn_position (V) m where the list of planes is full
/// Cost:   O(F log T + drawn triangles * body triangles near their face), no allocation. Errors: none.
struct MeshClearance {
  const Garment* garment = nullptr;
  const TessellationPattern* pattern = nullptr;
  ConstVec3View footprint;
  Vec3 origin{};  // of positions, m in the world
  const CollisionBodies* bodies = nullptr;
  const MeshCollider* const* meshes = nullptr;  // bodies->mesh_count() of them, in that order
  std::uint32_t collides_with = kAllGroups;
  float t = 1.0f;          // fraction of the tick at which the bodies are asked for
  float clearance = 0.0f;  // m
  NearTriangleView near;   // room for the largest body
  ClearanceList planes;
  Vec3View drawn_position;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
