// Which features of a cloth may come to touch those of the layers below it.
#pragma once

#include <span>

#include "systems/near_search.h"

namespace pleat {

/// Looks for pairs in a tick's first substep, and again where the cloths have moved against each other by more than a
/// margin of 0.15 edges since. A pair that was there before keeps the side that it remembers.
/// Reads:  garments; position (predicted), previous (P) m; clothes
/// Writes: pairs; sought_at (P) m; t_sought; scratch; stats.contacts_dropped: pairs beyond the capacity
/// Cost:   O(clothes + P of those near), when it looks O(P + E + F) of them; no allocation. Errors: none.
struct LayerCandidates {
  const Garment* garment = nullptr;
  ConstVec3View position, previous;
  std::uint32_t layer = 0;
  std::span<const LayerCloth> clothes;  // of these, the ones of layers 1 .. layer - 1 are below
  float t0 = 0.0f, t1 = 1.0f;           // fractions of the tick: begin and end of the substep
  float distance = 0.0f;                // m, to be kept
  NearPairList pairs;                   // *pairs.count == kNone: there is nothing yet
  Vec3View sought_at;
  float* t_sought = nullptr;  // the fraction of the tick for which the pairs were looked for
  NearScratch* scratch = nullptr;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
