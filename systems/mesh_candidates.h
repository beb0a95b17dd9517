// What of a cloth may touch what of the mesh bodies before the tick is over.
//
// The tree is asked once for each cluster of faces, for all that these and the body sweep. What it names is far too
// much where both move fast side by side; so a pair is kept only if it comes near in the frame that drifts with the
// face:
//
//      in the world                        drifting with the face
//   face   body ->                         face   body
//   ====>  /----->/   boxes overlap        ====   /-/    they do not
#pragma once

#include "components/colliders.h"
#include "components/garment.h"
#include "components/mesh_candidates.h"
#include "systems/collision_bodies.h"

namespace pleat {

/// Fills `candidates` in the first substep of a tick, and again where a particle has left its predicted path by more
/// than some mm or moves too fast for what was gathered; else it does nothing. Where bodies stand and the cloth hardly
/// moves what was found holds in the ticks that follow too, where a worker has no other cloth in between.
/// Reads:  garment edges, faces; position, previous (P) m; velocity (P) m/s; meshes and their trees
/// Writes: candidates, which have room for the vertices of each mesh
/// Cost:   O(P + bodies); when it gathers O(F log T + pairs); no allocation. Errors: none; see
/// MeshCandidateColumns::complete.
struct MeshCandidates {
  const Garment* garment = nullptr;
  ConstVec3View position;  // predicted
  ConstVec3View previous;  // when the substep began
  ConstVec3View velocity;
  const float* inverse_mass = nullptr;
  Vec3 origin{};  // of positions, m in the world
  const CollisionBodies* bodies = nullptr;
  const MeshCollider* const* meshes = nullptr;  // bodies->mesh_count() of them, in that order
  float t0 = 0.0f, t1 = 1.0f;                   // fractions of the tick: begin and end of the substep
  float thickness = 0.0f;                       // m
  float dt = 0.0f;                              // s, of the substep
  MeshCandidateColumns* candidates = nullptr;
  std::uint32_t collides_with = kAllGroups;

  bool validate() const;
  void run() const;

 private:
  bool still_hold(float reach) const;
  void adapt_slack() const;
};

}  // namespace pleat
