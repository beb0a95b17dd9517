// Which features of a cloth may come to touch each other.
//   L. Verlet, 1967: what is found within a margin stays complete until something has moved by half of the margin.
#pragma once

#include "systems/near_search.h"

namespace pleat {

/// Looks for pairs anew when a particle has moved by more than half the margin, 0.15 edges, against the
/// cloth's mean motion since the last time; until then the pairs stay as they are. A pair that was there before keeps
/// the side that it remembers.
/// Two features that are near each other at rest keep no more than half of their distance there, so that the rest shape
/// itself never makes a contact; and none keep more than most_distance, since folds between stiff triangles leave no
/// more room.
/// Reads:  garment faces, edges, rest positions; position (predicted), previous (P) m
/// Writes: pairs; sought_at (P) m; scratch; stats.contacts_dropped: pairs beyond the capacity
/// Cost:   O(P) while nothing has moved, else O(P + E + F) for a cloth of triangles of like size; no allocation.
/// Errors: none.
struct SelfCandidates {
  const Garment* garment = nullptr;
  ConstVec3View position, previous;
  float distance = 0.0f;  // m, to be kept
  NearPairList pairs;     // *pairs.count == kNeverSought: there is nothing yet
  Vec3View sought_at;
  NearScratch* scratch = nullptr;  // pairs.capacity pairs

  static constexpr std::uint32_t kNeverSought = kNone;
  static float most_distance(const Garment& garment) { return 0.25f * garment.mean_edge_length; }

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
