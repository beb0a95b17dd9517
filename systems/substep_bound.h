// How short substeps have to be for a fast limb not to pass through the cloth.
#pragma once

#include <optional>

#include "systems/collision_bodies.h"

namespace pleat {

/// How many substeps it takes so that in none of them a body near the cloth that it meets moves, relative to it, by
/// more than what contact rows can take back: for a capsule `reach` of radius + thickness, for a mesh as far as
/// features are looked for. Within that, rows remember the side on which the cloth was. Motion is measured from the
/// mean velocity u of the cloth, so that a body that carries its cloth along asks for nothing:
///   n = (max |x1 - x0 - u dt| + max |v_i - u| dt) / (reach (r + thickness))       or thickness + kLeastMargin
/// and for a cloth that is carried rigidly from its motion M, max |x1 - M(x0)|, over what of that contact takes back in
/// a tick, kRecoverySpeed dt, and of a mesh's margin `reach`, at most. Of a capsule the part that comes near.
/// Reads:  position (P) m; velocity (P) m/s; capsules and meshes between their poses of this tick; bodies as of it
/// Cost:   O(P + capsules near the cloth + vertices of meshes), no allocation. Errors: none; motion beyond all bounds
/// asks for kMost.
struct SubstepBound {
  static constexpr float kMost = 1e6f;

  std::size_t particle_count = 0;
  ConstVec3View position, velocity;
  Vec3 origin{};  // of positions, m in the world
  const CapsuleColumns* capsules = nullptr;
  const CollisionBodies* bodies = nullptr;  // knows which capsules are near
  const MeshCollider* const* meshes = nullptr;
  std::uint32_t mesh_count = 0;
  std::uint32_t collides_with = kAllGroups;
  float thickness = 0.0f;                 // m
  float dt = 0.0f;                        // s, of the tick
  float reach = 0.5f;                     // of a capsule's radius + thickness, that a substep may take
  std::optional<RigidMotion> carry = {};  // of the cloth, as its positions

  bool validate() const;
  /// Before it is rounded up; 0 where nothing moves.
  float run() const;
};

}  // namespace pleat
