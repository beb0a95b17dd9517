#include "systems/layer_candidates.h"

#include <algorithm>
#include <limits>

namespace pleat {
namespace {

constexpr float kSkin = 0.1f;  // m, by which a cloth may leave its box until the others around it are sought anew

/// What crosses in this substep is no further beyond than the two have moved against each other in it, m.
float motion_in_substep(const LayerCandidates& in, const LayerCloth& other) {
  const Vec3 mean = mean_motion(in.previous, in.position, in.garment->particle_count);
  return largest_motion(mean, in.previous, in.position, in.garment->particle_count) +
         largest_motion(mean, other.begin, other.end, other.garment->particle_count, in.t1 - in.t0);
}

/// All of one cloth below.
void search(const LayerCandidates& in, std::uint32_t cloth, NearMemory& memory, Stats& stats) {
  const LayerCloth& other = in.clothes[cloth];
  const float reach =
      std::max(2.0f * in.distance + near_margin(*in.garment, *other.garment), motion_in_substep(in, other));
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

/// visit(k) for all that are near the box.
template <class Visit>
void for_each_near(const LayerCandidates& in, const Box& box, const Visit& visit) {
  for (std::uint32_t k = in.around->begin; k < in.around->end; ++k) {
    if (may_touch(*in.garment, in.layer, in.distance, box, in.clothes[k])) visit(k);
  }
}

/// Whether the pairs are all that may touch still. As paths of others are known in this tick only, a tick's last
/// substep keeps what they moved in it against the cloth's motion as a whole; over all ticks both add up to more than
/// any two have moved against each other. One that was not near when pairs were sought was farther away than they reach
/// by more than the margin.
bool still_hold(const LayerCandidates& in, const Box& box) {
  LayersSought& last = *in.sought;
  const Vec3 motion = mean_motion(in.sought_at, in.position, in.garment->particle_count);
  float others = 0.0f, margin = std::numeric_limits<float>::max();
  const auto add = [&](std::uint32_t k) {
    const LayerCloth& other = in.clothes[k];
    others = std::max(others, largest_motion(motion - last.motion, other.begin, other.end,
                                             other.garment->particle_count, in.t1 - last.t));
    margin = std::min(margin, near_margin(*in.garment, *other.garment));
  };
  if (last.near.too_many()) {
    for_each_near(in, box, add);
  } else {
    std::ranges::for_each(last.near.kept(), add);
  }
  others += last.others;
  if (largest_motion(motion, in.sought_at, in.position, in.garment->particle_count) + others > margin) return false;
  if (in.t1 == 1.0f) last.motion = motion, last.others = others;
  return true;
}

}  // namespace

bool may_touch(const Garment& garment, std::uint32_t layer, float distance, const Box& box, const LayerCloth& other) {
  if (other.layer == 0 || other.layer >= layer) return false;
  const float reach = 2.0f * (distance + near_margin(garment, *other.garment));
  return box.grown(reach).overlaps({other.low, other.high});
}

bool LayerCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && layer > 0 && distance >= 0.0f &&
         t0 < t1 && pairs.pairs != nullptr && pairs.count != nullptr && sought_at.x != nullptr && sought != nullptr &&
         around != nullptr && scratch != nullptr && scratch->pairs.size() >= pairs.capacity &&
         scratch->holds(garment->particle_count, garment->edge_count) && holds_all(*scratch, clothes);
}

void LayerCandidates::run(Stats& stats) const {
  const std::uint32_t count = garment->particle_count;
  const Box box = box_of(previous, count).with(box_of(position, count)).moved(origin);
  if (!around->box.holds(box)) *around = seek(*this, box.grown(kSkin));
  LayersNear near;
  for_each_near(*this, box, [&](std::uint32_t k) { near.add(k); });
  if (t0 == 0.0f) sought->t = 0.0f;
  std::uint32_t kept = 0;
  if (*pairs.count != kNone) {
    const bool due = t0 == 0.0f && (near.too_many() || sought->cut);
    if (!due && near == sought->near && still_hold(*this, box)) return;
    kept = *pairs.count;
    std::copy(pairs.pairs, pairs.pairs + kept, scratch->pairs.data());
  }
  copy(sought_at, position, garment->particle_count);
  *sought = {.near = near, .motion = {}, .others = 0.0f, .t = t1, .cut = false};
  *pairs.count = 0;
  NearMemory memory{scratch->pairs.data(), scratch->pairs.data() + kept};
  const std::uint64_t dropped = stats.contacts_dropped;
  for_each_near(*this, box, [&](std::uint32_t k) { search(*this, k, memory, stats); });
  sought->cut = stats.contacts_dropped != dropped;
}

}  // namespace pleat
