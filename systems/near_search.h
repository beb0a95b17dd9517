// The search for pairs of features that may come to touch, of one cloth or of two.
#pragma once

#include <span>

#include "components/garment.h"
#include "components/near_pairs.h"
#include "components/stats.h"

namespace pleat {

/// A cloth at one moment.
struct PosedCloth {
  const Garment* garment = nullptr;
  ConstVec3View position;  // (P) m
};

/// Whether there is room for each cloth that is seen.
bool holds_all(const NearScratch& scratch, std::span<const LayerCloth> clothes);
/// How far two cloths may move against each other until pairs are sought anew, m: 0.15 edges.
float near_margin(const Garment& first, const Garment& second);
/// The mean motion of particles, m.
Vec3 mean_motion(ConstVec3View from, ConstVec3View to, std::uint32_t count);
/// How far one moves at most against `reference` on a part of its way, m.
float largest_motion(const Vec3& reference, ConstVec3View from, ConstVec3View to, std::uint32_t count,
                     float part = 1.0f);

/// Puts the middles of a cloth's edges, m, into the scratch. Returns half of the longest edge's length, m.
float file_middles(const PosedCloth& cloth, NearScratch& scratch);

/// Pairs of the last search, from which sides are taken over.
struct NearMemory {
  const NearPair* next = nullptr;  // walks along as searches ask in the order of the list
  const NearPair* end = nullptr;
};

/// Finds pairs by a grid. Particles count over the inside of a face and up to 0.1 edges and the margin beside it.
struct NearSearch {
  PosedCloth first, second;
  bool itself = false;      // first and second are the same cloth
  std::uint32_t cloth = 0;  // of the pairs
  float distance = 0.0f;    // m, to be kept
  float reach = 0.0f;       // m
  NearScratch* scratch = nullptr;
  NearMemory* memory = nullptr;
  NearPairList pairs;  // added to

  /// Particles of the first cloth and faces of the second; of one cloth, those that are no corner.
  void find_particle_face(NearKind kind, Stats& stats) const;
  /// Edges of the first and of the second cloth; of one cloth, each two that share no particle once.
  void find_edges(Stats& stats) const;
};

}  // namespace pleat
