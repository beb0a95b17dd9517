#include "systems/self_candidates.h"

#include <algorithm>

namespace pleat {
namespace {

constexpr float kMarginShare = 0.15f;  // of the mean edge length
constexpr float kOverlapShare = 0.1f;  // of the mean edge length: so far beside a face it is still touched

/// The furthest that a particle has moved away from the mean motion, m.
float relative_motion(ConstVec3View from, ConstVec3View to, std::uint32_t count) {
  Vec3 sum;
  for (std::uint32_t i = 0; i < count; ++i) sum += to[i] - from[i];
  const Vec3 mean = sum * (1.0f / static_cast<float>(count));
  float most2 = 0.0f;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 d = to[i] - from[i] - mean;
    most2 = std::max(most2, dot(d, d));
  }
  return std::sqrt(most2);
}

}  // namespace

bool SelfCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && distance >= 0.0f &&
         pairs.pairs != nullptr && pairs.count != nullptr && sought_at.x != nullptr && scratch != nullptr &&
         scratch->pairs.size() >= pairs.capacity && scratch->grid.holds(NearSearch::most_points(*garment)) &&
         scratch->middle.size() >= garment->edge_count;
}

void SelfCandidates::run(Stats& stats) const {
  const std::uint32_t count = garment->particle_count;
  const float margin = kMarginShare * garment->mean_edge_length;
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
                          .wide = kOverlapShare * garment->mean_edge_length + margin,
                          .scratch = scratch,
                          .memory = &memory,
                          .pairs = pairs};
  search.find_particle_face(NearKind::kParticleFace, stats);
  search.find_edges(stats);
}

}  // namespace pleat
