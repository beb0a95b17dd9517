// Where a cloth touches itself.
//   R. Bridson, R. Fedkiw, J. Anderson, "Robust Treatment of Collisions, Contact and Friction for Cloth Animation",
//   2002, sections 6 and 7: repulsion between a point and a triangle, shared by the four particles. Here it is one row
//   of the sweeps, and what crossed a face returns to the side where it was.
#pragma once

#include "components/contacts.h"
#include "components/garment.h"
#include "components/self_contacts.h"
#include "components/stats.h"

namespace pleat {

/// Adds a row for each pair whose particle is over or under the inside of its face and nearer than its distance +
/// contact_margin, at the end of the substep, or beyond the face. The particle's side is that of the begin of the
/// substep in which it came over the face, and is remembered while it stays there: a particle that was forced through
/// comes back. Moves are shared by inverse mass, so momentum is kept.
/// Not seen: an edge against an edge, and a particle that passes a face within a substep on its way past it.
/// Reads:  garment faces; position, previous (P) m; inverse_mass (P) 1/kg
/// Writes: side of the pairs; contacts, added to; stats.contacts_dropped
/// Cost:   O(pairs), no allocation. Errors: none; a face without extent makes no row.
struct SelfDetection {
  const Garment* garment = nullptr;
  ConstVec3View position;  // predicted
  ConstVec3View previous;  // when the substep began
  const float* inverse_mass = nullptr;
  SelfPairList pairs;
  float friction = 0.0f;
  float dt = 0.0f;  // s, of the substep
  ContactList contacts;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
