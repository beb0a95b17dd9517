// Which particles of a cloth may come to touch which of its faces.
//   M. Teschner, B. Heidelberger, M. Mueller, D. Pomeranets, M. Gross, "Optimized Spatial Hashing for Collision
//   Detection of Deformable Objects", 2003: particles are filed in the cells of a hashed grid, faces ask the cells they
//   overlap. L. Verlet, 1967: what is found within a margin stays complete until something has moved by half of the
//   margin.
#pragma once

#include "components/garment.h"
#include "components/self_contacts.h"
#include "components/stats.h"

namespace pleat {

/// Looks for pairs anew when a particle has moved by more than half the margin against the cloth's mean motion since
/// the last time; until then the pairs stay as they are. Each particle within distance + margin of the prism over a
/// face makes a pair, but for the face's own corners. A pair that was there before keeps the side that it remembers.
/// Two features that are near each other at rest keep no more than half of their distance there, so that the rest shape
/// itself never makes a contact.
/// Reads:  garment faces, rest positions; position (predicted), previous (P) m
/// Writes: pairs; sought_at (P) m; scratch; stats.contacts_dropped: pairs beyond the capacity
/// Cost:   O(P) while nothing has moved, else O(P + F) for a cloth whose faces are of like size; no allocation.
/// Errors: none. A face that is stretched over more cells than there are particles asks all particles.
struct SelfCandidates {
  const Garment* garment = nullptr;
  ConstVec3View position, previous;
  float distance = 0.0f;  // m, to be kept
  SelfPairList pairs;     // *pairs.count == kNeverSought: there is nothing yet
  Vec3View sought_at;
  SelfPair* pair_scratch = nullptr;       // pairs.capacity
  std::uint32_t* cell_scratch = nullptr;  // cell_scratch_size(P)

  static constexpr std::uint32_t kNeverSought = kNone;
  static std::size_t cell_scratch_size(std::size_t particle_count);

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
