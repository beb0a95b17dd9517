#include "systems/self_detection.h"

#include <array>

#include "systems/close_pairs.h"
#include "systems/closeness.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// The pairs of one cloth with itself, for for_each_close_pair.
struct SelfPairs {
  const SelfDetection& in;

  std::array<std::uint32_t, 4> corners_of(const NearPair& pair) const {
    const auto& corner = in.garment->face_particle;
    const auto& end = in.garment->edge_particle;
    const std::uint32_t f = pair.first, s = pair.second;
    if (pair.kind == NearKind::kEdges) return {end[0][f], end[1][f], end[0][s], end[1][s]};
    return {f, corner[0][s], corner[1][s], corner[2][s]};
  }
  PLEAT_KERNEL Vec3Lanes end(const NearPair&, std::uint32_t, const std::uint32_t* index) const {
    return gather(in.position, index);
  }
  PLEAT_KERNEL Vec3Lanes begin(const NearPair&, std::uint32_t, const std::uint32_t* index) const {
    return gather(in.previous, index);
  }
};

void add_row(const SelfDetection& in, NearPair& pair, const ContactRowMaker& rows, Stats& stats) {
  if (pair.kind == NearKind::kParticleFace && in.garment->particle_area[pair.first] == 0.0f) {
    return;  // a vertex without a triangle is no part of the cloth
  }
  const auto [a, b, c, d] = SelfPairs{in}.corners_of(pair);
  const Vec3 x[4] = {in.position[a], in.position[b], in.position[c], in.position[d]};
  const Vec3 before[4] = {in.previous[a], in.previous[b], in.previous[c], in.previous[d]};
  Closeness near;
  if (!closeness(pair.kind, x, before, pair.side, near) || near.distance > 2.0f * pair.distance) return;
  rows.add({.particle = {a, b, c, d},
            .weight = {near.weight[0], near.weight[1], near.weight[2], near.weight[3]},
            .normal = near.normal,
            .offset = pair.distance,
            .body_step = {},
            .friction = in.friction,
            .share = {},
            .count = 4,
            .push = 0.0f,
            .rubbed = 0.0f},
           stats);
}

}  // namespace

bool SelfDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         pairs.pairs != nullptr && pairs.count != nullptr && friction >= 0.0f && dt > 0.0f && contacts.count != nullptr;
}

void SelfDetection::run(Stats& stats) const {
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  run_wide(widest_vectors(), [&] {
    for_each_close_pair(pairs, SelfPairs{*this}, [&](NearPair& pair) { add_row(*this, pair, rows, stats); });
  });
}

}  // namespace pleat
