// Where a cloth touches itself.
//   R. Bridson, R. Fedkiw, J. Anderson, "Robust Treatment of Collisions, Contact and Friction for Cloth Animation",
//   2002, sections 6 and 7: repulsion between a point and a triangle and between two edges, shared by the four
//   particles. Here it is one row of the sweeps, and what crossed returns to the side where it was.
#pragma once

#include "components/contacts.h"
#include "components/garment.h"
#include "components/near_pairs.h"
#include "components/stats.h"

namespace pleat {

/// Adds a row for each pair that is nearer than twice its distance at the end of the substep, or on the wrong side. The
/// side is that of the begin of the substep in which the two came over each other, and is remembered while they stay
/// so: what was forced through comes back. Moves are shared by inverse mass, so momentum is kept.
/// Not seen: features that pass each other within a substep on their way past each other's end, and edges that cross
/// while nearly parallel.
/// Reads:  garment faces, edges; position, begin (P), packed, previous (P) m; inverse_mass (P) 1/kg
/// Writes: side of the pairs; contacts, added to; stats.contacts_dropped
/// Cost:   O(pairs), no allocation. Errors: none; features without extent make no row.
struct SelfDetection {
  const Garment* garment = nullptr;
  const Vec4* position = nullptr;  // predicted
  const Vec4* begin = nullptr;     // when the substep began
  ConstVec3View previous;          // the same
  const float* inverse_mass = nullptr;
  NearPairList pairs;
  float friction = 0.0f;
  float dt = 0.0f;  // s, of the substep
  ContactList contacts;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
