// Where the capsules near a cloth are in a substep.
#pragma once

#include "components/colliders.h"
#include "components/stats.h"
#include "systems/box.h"
#include "systems/collision_bodies.h"

namespace pleat {

/// Picks the capsules that the cloth meets and whose swept box comes within `reach` of its particles, and some more,
/// and moves them in a straight line from their previous to their next pose: the substep ends at the fraction t1 of the
/// tick and began at t0. A world may hold thousands of capsules; a cloth meets its few through Bullet's tree, and keeps
/// them for the tick while it stays in the box for which they were sought. Runs after integration.
///
/// Reads:  capsules, bodies (their tree); position (P) m
/// Writes: poses (at most `capacity`), ascending by index; pose_count; sought; stats.contacts_dropped
/// Cost:   O(P + hits), and O(log capsules + hits log hits) where they are sought; no allocation.
/// Errors: none; hits beyond `capacity` are counted.
struct ColliderMotion {
  const CapsuleColumns* capsules = nullptr;
  const CollisionBodies* bodies = nullptr;
  std::uint32_t particle_count = 0;
  ConstVec3View position;
  Vec3 origin{};       // of positions and poses, m in the world
  float reach = 0.0f;  // m
  float t0 = 0.0f, t1 = 1.0f;
  CapsulePose* poses = nullptr;
  std::uint32_t capacity = 0;
  std::uint32_t* pose_count = nullptr;
  Box* sought = nullptr;  // no capsule but those of `poses` comes into it in this tick; as made: not sought yet
  std::uint32_t collides_with = kAllGroups;

  bool validate() const;
  void run(Stats& stats) const;

 private:
  /// Returns how many there are.
  std::uint32_t seek(const Box& box) const;
};

}  // namespace pleat
