#include "systems/layer_candidates.h"

#include <algorithm>

#include "systems/box.h"
#include "systems/closest_points.h"

namespace pleat {
namespace {

/// The furthest that a particle of either moves against one of the other, m: from one position to another, and between
/// two fractions of the tick.
float relative_motion(const LayerCandidates& in, ConstVec3View from, float t_from, const LayerCloth& other) {
  const Vec3 mean = mean_motion(from, in.position, in.garment->particle_count);
  return largest_motion(mean, from, in.position, in.garment->particle_count) +
         largest_motion(mean, other.begin, other.end, other.garment->particle_count, in.t1 - t_from);
}

bool is_below(const LayerCloth& other, std::uint32_t layer) { return other.layer > 0 && other.layer < layer; }

Box box_around(const LayerCloth& other) { return {other.low, other.high}; }

/// All of one cloth below.
void search(const LayerCandidates& in, std::uint32_t cloth, const Box& box, NearMemory& memory, Stats& stats) {
  const LayerCloth& other = in.clothes[cloth];
  const float margin = near_margin(*in.garment, *other.garment);
  // What crosses in this substep is no further beyond than it has moved.
  const float reach = std::max(2.0f * in.distance + margin, relative_motion(in, in.previous, in.t0, other));
  if (!box.grown(reach + margin).overlaps(box_around(other))) return;
  const Vec3View pose = in.scratch->pose.view();
  for (std::uint32_t i = 0; i < other.garment->particle_count; ++i) {
    pose.set(i, lerp(other.begin[i], other.end[i], in.t1));
  }
  const PosedCloth own{in.garment, in.position}, below{other.garment, pose};
  NearSearch near{.first = own,
                  .second = below,
                  .itself = false,
                  .cloth = cloth,
                  .distance = in.distance,
                  .reach = reach,
                  .scratch = in.scratch,
                  .memory = &memory,
                  .pairs = in.pairs};
  near.find_particle_face(NearKind::kParticleFace, stats);
  near.find_edges(stats);
  std::swap(near.first, near.second);
  near.find_particle_face(NearKind::kOtherParticleFace, stats);
}

}  // namespace

bool LayerCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && layer > 0 && distance >= 0.0f &&
         t0 < t1 && pairs.pairs != nullptr && pairs.count != nullptr && sought_at.x != nullptr && t_sought != nullptr &&
         scratch != nullptr && scratch->pairs.size() >= pairs.capacity &&
         scratch->grid.holds(NearSearch::most_points(*garment));
}

void LayerCandidates::run(Stats& stats) const {
  const Box box = box_of(position, garment->particle_count);
  const auto still_holds = [&](const LayerCloth& other) {
    if (!is_below(other, layer)) return true;
    const float margin = near_margin(*garment, *other.garment);
    return !box.grown(2.0f * distance + 2.0f * margin).overlaps(box_around(other)) ||
           relative_motion(*this, sought_at, *t_sought, other) <= margin;
  };
  std::uint32_t kept = 0;
  if (*pairs.count != kNone) {
    if (t0 > 0.0f && std::ranges::all_of(clothes, still_holds)) return;
    kept = *pairs.count;
    std::copy(pairs.pairs, pairs.pairs + kept, scratch->pairs.data());
  }
  copy(sought_at, position, garment->particle_count);
  *t_sought = t1;
  *pairs.count = 0;
  NearMemory memory{scratch->pairs.data(), scratch->pairs.data() + kept};
  for (std::uint32_t k = 0; k < clothes.size(); ++k) {
    if (is_below(clothes[k], layer)) search(*this, k, box, memory, stats);
  }
}

}  // namespace pleat
