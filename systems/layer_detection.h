// Where a cloth touches the layers below it.
#pragma once

#include <span>

#include "components/contacts.h"
#include "components/garment.h"
#include "components/near_pairs.h"
#include "components/stats.h"

namespace pleat {

/// Adds a row for each pair that is nearer than twice its distance at the end of the substep, or on the wrong side, as
/// SelfDetection does. The cloth below is a body here: it moves as it has moved in this tick already, and is not
/// pushed.
/// Reads:  garments; position, begin (P), packed, previous (P) m; inverse_mass (P) 1/kg; clothes
/// Writes: side of the pairs; contacts, added to; scratch; stats.contacts_dropped
/// Cost:   O(pairs + P of the cloths in them), no allocation. Errors: none; features without extent make no row.
struct LayerDetection {
  const Garment* garment = nullptr;
  const Vec4* position = nullptr;  // predicted
  const Vec4* begin = nullptr;     // when the substep began
  ConstVec3View previous;          // the same
  Vec3 origin{};                   // of these, m in the world
  const float* inverse_mass = nullptr;
  std::span<const LayerCloth> clothes;
  float t0 = 0.0f, t1 = 1.0f;  // fractions of the tick: begin and end of the substep
  NearPairList pairs;
  float friction = 0.0f;
  float dt = 0.0f;  // s, of the substep
  NearScratch* scratch = nullptr;
  ContactList contacts;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
