// Where a cloth touches the triangles of a mesh body.
#pragma once

#include "components/colliders.h"
#include "components/contacts.h"
#include "components/garment.h"
#include "components/mesh_candidates.h"
#include "components/stats.h"
#include "systems/collision_bodies.h"

namespace pleat {

/// Adds rows against mesh bodies at the fraction t1 of the tick, the end of the substep:
///   particles: against the nearest point of the body; the angle-weighted normal there tells inside from outside
///              (J. Baerentzen, H. Aanaes, 2005). One inside is pushed out if it is no deeper than 30 mm;
///   edges:     against ridges of the body, while the normal lies between those of the ridge's two triangles, and
///              against vertices that stand out towards the edge and are over neither of its faces;
///   faces:     against vertices of the body that stand out towards the face.
/// Edges and faces leave out what another row says already, so that rows stay few on smooth bodies; but not what comes
/// to matter when the sweeps turn an edge or a face by a slope of 0.2.
/// Reads:  garment edges, faces; position, previous (P) m; inverse_mass (P) 1/kg; meshes and their trees
/// Writes: contacts, added to; stats.contacts_dropped; scratch of the candidates
/// Cost:   O(candidates), without them some times O(F log T + close pairs); no allocation. Errors: none; features
/// without extent make finite rows or none.
struct MeshDetection {
  const Garment* garment = nullptr;
  ConstVec3View position;        // predicted
  const Vec4* packed = nullptr;  // the same
  ConstVec3View previous;        // when the substep began
  const float* inverse_mass = nullptr;
  Vec3 origin{};  // of positions, m in the world
  const CollisionBodies* bodies = nullptr;
  const MeshCollider* const* meshes = nullptr;  // bodies->mesh_count() of them, in that order
  /// Null or incomplete: the trees are asked instead, the rows are the same and in the same order.
  MeshCandidateColumns* candidates = nullptr;
  float t0 = 0.0f, t1 = 1.0f;
  float thickness = 0.0f;  // m
  float friction = 0.0f;
  float dt = 0.0f;  // s, of the substep
  ContactList contacts;
  std::uint32_t collides_with = kAllGroups;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
