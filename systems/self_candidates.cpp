#include "systems/self_candidates.h"

#include <algorithm>

namespace pleat {
namespace {

/// The furthest that a particle has moved away from the mean motion, m.
float relative_motion(ConstVec3View from, ConstVec3View to, std::uint32_t count) {
  return largest_motion(mean_motion(from, to, count), from, to, count);
}

}  // namespace

bool SelfCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && distance >= 0.0f &&
         pairs.pairs != nullptr && pairs.count != nullptr && sought_at.x != nullptr && scratch != nullptr &&
         scratch->pairs.size() >= pairs.capacity && scratch->holds(garment->particle_count, garment->edge_count);
}

void SelfCandidates::run(Stats& stats) const {
  const std::uint32_t count = garment->particle_count;
  const float margin = near_margin(*garment, *garment);
  std::uint32_t kept = 0;
  if (*pairs.count != kNeverSought) {
    if (relative_motion(sought_at, position, count) <= 0.5f * margin) return;
    kept = *pairs.count;
    std::copy(pairs.pairs, pairs.pairs + kept, scratch->pairs.data());
  }
  copy(sought_at, position, count);

  // What crosses in this substep is no further beyond than it has moved.
  const float kept_distance = std::min(distance, most_distance(*garment));
  const float reach = std::max(2.0f * kept_distance + margin, 2.0f * relative_motion(previous, position, count));
  const PosedCloth cloth{garment, position};
  NearMemory memory{scratch->pairs.data(), scratch->pairs.data() + kept};
  *pairs.count = 0;
  const NearSearch search{.first = cloth,
                          .second = cloth,
                          .itself = true,
                          .distance = kept_distance,
                          .reach = reach,
                          .scratch = scratch,
                          .memory = &memory,
                          .pairs = pairs};
  search.find_particle_face(NearKind::kParticleFace, stats);
  search.find_edges(stats);
}

}  // namespace pleat
