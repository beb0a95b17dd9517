// Which features of a cloth may come to touch those of the layers below it.
#pragma once

#include <span>

#include "systems/box.h"
#include "systems/near_search.h"

namespace pleat {

/// Whether a cloth that stays in the box, in the world, of this layer and keeping this distance, m, may touch the other
/// one in this tick, or comes so near that pairs are sought.
bool may_touch(const Garment& garment, std::uint32_t layer, float distance, const Box& box, const LayerCloth& other);

/// Clothes [begin, end): no other one may touch the cloth in this tick while it stays in the box.
struct LayersAround {
  Box box;  // in the world; as made, nothing stays in it
  std::uint32_t begin = 0, end = 0;
};

/// Looks for pairs anew where others are near than when it last did, or where the cloths have moved against each other
/// by more than a margin of 0.15 edges since; until then the pairs stay as they are. What they move is added up tick by
/// tick: cloth at rest looks for nothing. Where more than 16 cloths are near, or not all pairs found room, it looks as
/// a tick begins too. A pair that was there before keeps the side that it remembers.
/// Reads:  garments; position (predicted), previous (P) m; clothes
/// Writes: pairs; sought_at (P) m; sought; around; scratch; stats.contacts_dropped: pairs beyond the capacity
/// Cost:   O(P + P of those near + clothes from the first to the last one around), when it looks O(P + E + F) of those
///         near, and once a tick O(clothes); no allocation. To be run in every substep of every tick in which one of
///         those near moves.
/// Errors: none.
struct LayerCandidates {
  const Garment* garment = nullptr;
  ConstVec3View position, previous;
  Vec3 origin{};  // of these, m in the world
  std::uint32_t layer = 0;
  std::span<const LayerCloth> clothes;  // of these, the ones of layers 1 .. layer - 1 are below
  float t0 = 0.0f, t1 = 1.0f;           // fractions of the tick: begin and end of the substep
  float distance = 0.0f;                // m, to be kept
  NearPairList pairs;                   // *pairs.count == kNone: there is nothing yet
  Vec3View sought_at;
  LayersSought* sought = nullptr;  // of these pairs
  LayersAround* around = nullptr;  // kept for the tick
  NearScratch* scratch = nullptr;

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
