// Where a cloth touches half-spaces: grounds, walls, moving platforms.
#pragma once

#include "components/colliders.h"
#include "components/contacts.h"
#include "components/stats.h"

namespace pleat {

/// Adds a row for each particle nearer than thickness + contact_margin to a plane at the fraction t1 of the tick, the
/// end of the substep. A half-space is met by a triangle at its corners first, so edges and faces need no rows.
/// Reads:  position, previous (P) m; inverse_mass (P) 1/kg; planes
/// Writes: contacts, added to; stats.contacts_dropped
/// Cost:   O(P planes), no allocation. Errors: none.
struct PlaneDetection {
  std::uint32_t particle_count = 0;
  ConstVec3View position;  // predicted
  ConstVec3View previous;  // when the substep began
  Vec3 origin{};           // of positions, m in the world
  const float* inverse_mass = nullptr;
  const PlaneCollider* planes = nullptr;
  std::size_t plane_count = 0;
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
