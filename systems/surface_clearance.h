// Keeps the drawn surface out of the capsules and above the planes that the cloth touches.
//
// Contact keeps the coarse triangles outside, but the curved surface between them bulges up to some centimetres towards
// the body. A drawn triangle lies over a small flat one, its footprint on the coarse triangle, and that one is outside:
//
//        drawn  a_____            Where the footprint and the core of the capsule come closest, the direction n from
//             /       \__c        core to footprint separates them: the footprint lies beyond the plane that is
//   footprint A------B---C        square to n and touches the capsule. The three drawn vertices that fell behind it
//   - - - - - - - - - - - plane   are lifted to it.
//          ( capsule )
//
// The drawn triangle is then beyond a plane that the capsule is behind, hence outside: no sampling, no inflation by the
// triangle's size, and no doubt about the side even where the surface had fallen behind the core. The nearest points of
// two convex sets give an n that is unique and moves continuously with them, so the surface does not pop; vertices are
// shared, so it does not crack; and where nothing bulges behind a plane it is left as it is, bit for bit.
#pragma once

#include "components/colliders.h"
#include "components/garment.h"
#include "components/tessellation_pattern.h"
#include "systems/clearance_list.h"

namespace pleat {

/// Moves drawn vertices so that every drawn triangle keeps at least `clearance` from every capsule and plane, up to
/// rounding. One sweep does it where the planes at a vertex agree (all angles between their normals are at most 90
/// degrees); where they do not, as between two legs, sweeps repeat and converge as long as the coarse triangles are
/// outside.
/// Reads:  garment faces; pattern; position (P) m; capsules; half-spaces; planes that other systems have gathered
///         already
/// Writes: drawn_position (V) m; planes, which are settled
/// Cost:   O(V + F capsules + drawn triangles near a capsule), no allocation. Errors: none.
struct SurfaceClearance {
  const Garment* garment = nullptr;
  const TessellationPattern* pattern = nullptr;
  ConstVec3View position;
  Vec3 origin{};  // of positions and capsules, m in the world
  const CapsulePose* capsules = nullptr;
  std::uint32_t capsule_count = 0;
  const PlaneCollider* half_spaces = nullptr;
  std::size_t half_space_count = 0;
  std::uint32_t collides_with = kAllGroups;
  float t = 1.0f;                // fraction of the tick at which the half-spaces are asked for
  float clearance = 0.0f;        // m
  const float* bulge = nullptr;  // (F) m, a column: how far the vertices of faces are from the flat triangles at most,
                                 // or null, for it to be measured
  ClearanceList planes;
  Vec3View drawn_position;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
