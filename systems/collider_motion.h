// Where the capsules near a cloth are in a substep.
#pragma once

#include "components/colliders.h"
#include "components/stats.h"
#include "systems/collision_bodies.h"

namespace pleat {

/// Picks the enabled capsules whose swept box comes within `reach` of the cloth's particles and moves them in a
/// straight line from their previous to their next pose: the substep ends at the fraction t1 of the tick and began at
/// t0. A world may hold thousands of capsules; a cloth meets its few through Bullet's tree. Runs after integration.
/// Reads:  capsules, bodies (their tree); position (P) m
/// Writes: poses (at most `capacity`), ascending by index; pose_count; stats.contacts_dropped
/// Cost:   O(P + log capsules + hits log hits), no allocation. Errors: none; hits beyond `capacity` are counted.
struct ColliderMotion {
  const CapsuleColumns* capsules = nullptr;
  const CollisionBodies* bodies = nullptr;
  std::uint32_t particle_count = 0;
  ConstVec3View position;
  float reach = 0.0f;  // m
  float t0 = 0.0f, t1 = 1.0f;
  CapsulePose* poses = nullptr;
  std::uint32_t capacity = 0;
  std::uint32_t* pose_count = nullptr;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
