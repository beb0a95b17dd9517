// How short substeps have to be for a fast limb not to pass through the cloth.
#pragma once

#include "systems/collision_bodies.h"

namespace pleat {

/// The number of substeps in which no enabled body near the cloth moves, relative to the cloth, by more than what
/// contact rows can take back: for a capsule half of radius + thickness, for a mesh as far as features are looked for.
/// Within that, rows remember the side on which the cloth was. Motion is measured from the mean velocity u of the
/// cloth, so that a body that carries its cloth along asks for nothing:
///   n = ceil((max |x1 - x0 - u dt| + max |v_i - u| dt) / ((r + thickness) / 2))     or thickness + kLeastMargin
/// Reads:  position (P) m; velocity (P) m/s; capsules and meshes between their poses of this tick; bodies as of it
/// Cost:   O(P + capsules near the cloth + vertices of meshes), no allocation. Errors: none; motion beyond all bounds
/// asks for kMost.
struct SubstepBound {
  static constexpr std::uint32_t kMost = 1000000;

  std::size_t particle_count = 0;
  ConstVec3View position, velocity;
  Vec3 origin{};  // of positions, m in the world
  const CapsuleColumns* capsules = nullptr;
  const CollisionBodies* bodies = nullptr;  // knows which capsules are near
  const MeshCollider* const* meshes = nullptr;
  std::uint32_t mesh_count = 0;
  float thickness = 0.0f;  // m
  float dt = 0.0f;         // s, of the tick

  bool validate() const;
  std::uint32_t run() const;
};

}  // namespace pleat
