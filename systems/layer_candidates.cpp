#include "systems/layer_candidates.h"

#include <algorithm>

#include "systems/closest_points.h"

namespace pleat {
namespace {

constexpr float kSkin = 0.1f;  // m, by which a cloth may leave its box until the others around it are sought anew

/// The furthest that a particle of either moves against one of the other, m: from one position to another, and between
/// two fractions of the tick.
float relative_motion(const LayerCandidates& in, ConstVec3View from, float t_from, const LayerCloth& other) {
  const Vec3 mean = mean_motion(from, in.position, in.garment->particle_count);
  return largest_motion(mean, from, in.position, in.garment->particle_count) +
         largest_motion(mean, other.begin, other.end, other.garment->particle_count, in.t1 - t_from);
}

/// All of one cloth below.
void search(const LayerCandidates& in, std::uint32_t cloth, NearMemory& memory, Stats& stats) {
  const LayerCloth& other = in.clothes[cloth];
  // What crosses in this substep is no further beyond than it has moved.
  const float reach = std::max(2.0f * in.distance + near_margin(*in.garment, *other.garment),
                               relative_motion(in, in.previous, in.t0, other));
  const Vec3View pose = in.scratch->pose.view();
  for (std::uint32_t i = 0; i < other.garment->particle_count; ++i) {
    pose.set(i, other.at(i, in.t1, in.origin));
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

/// Those around a cloth that stays in the box.
LayersAround seek(const LayerCandidates& in, const Box& box) {
  LayersAround around{.box = box};
  for (std::uint32_t k = 0; k < in.clothes.size(); ++k) {
    if (!may_touch(*in.garment, in.layer, in.distance, box, in.clothes[k])) continue;
    if (around.end == 0) around.begin = k;
    around.end = k + 1;
  }
  return around;
}

}  // namespace

bool may_touch(const Garment& garment, std::uint32_t layer, float distance, const Box& box, const LayerCloth& other) {
  if (other.layer == 0 || other.layer >= layer) return false;
  const float reach = 2.0f * (distance + near_margin(garment, *other.garment));
  return box.grown(reach).overlaps({other.low, other.high});
}

bool LayerCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && layer > 0 && distance >= 0.0f &&
         t0 < t1 && pairs.pairs != nullptr && pairs.count != nullptr && sought_at.x != nullptr && t_sought != nullptr &&
         around != nullptr && scratch != nullptr && scratch->pairs.size() >= pairs.capacity &&
         scratch->holds(garment->particle_count, garment->edge_count);
}

void LayerCandidates::run(Stats& stats) const {
  const std::uint32_t count = garment->particle_count;
  const Box box = box_of(previous, count).with(box_of(position, count)).moved(origin);
  if (!around->box.holds(box)) *around = seek(*this, box.grown(kSkin));
  const auto is_near = [&](const LayerCloth& other) { return may_touch(*garment, layer, distance, box, other); };
  const auto still_holds = [&](const LayerCloth& other) {
    return !is_near(other) ||
           relative_motion(*this, sought_at, *t_sought, other) <= near_margin(*garment, *other.garment);
  };
  std::uint32_t kept = 0;
  if (*pairs.count != kNone) {
    const auto some = clothes.subspan(around->begin, around->end - around->begin);
    if (t0 > 0.0f && std::ranges::all_of(some, still_holds)) return;
    kept = *pairs.count;
    std::copy(pairs.pairs, pairs.pairs + kept, scratch->pairs.data());
  }
  copy(sought_at, position, garment->particle_count);
  *t_sought = t1;
  *pairs.count = 0;
  NearMemory memory{scratch->pairs.data(), scratch->pairs.data() + kept};
  for (std::uint32_t k = around->begin; k < around->end; ++k) {
    if (is_near(clothes[k])) search(*this, k, memory, stats);
  }
}

}  // namespace pleat
