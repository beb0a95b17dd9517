#include "systems/self_detection.h"

#include "systems/close_pairs.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// The pairs of one cloth with itself, for for_each_close_pair.
struct SelfPairs {
  const SelfDetection& in;

  PairColumns columns_of(const NearPair& pair) const {
    const auto& corner = in.garment->face_particle;
    const auto& end = in.garment->edge_particle;
    PairColumns columns{{nullptr, corner[0].data(), corner[1].data(), corner[2].data()}, {}, {}};
    if (pair.kind == NearKind::kEdges) {
      columns.particle = {end[0].data(), end[1].data(), end[0].data(), end[1].data()};
    }
    columns.now.fill(in.position), columns.before.fill(in.begin);
    return columns;
  }
};

void add_row(const SelfDetection& in, const ClosePair& close, const ContactRowMaker& rows, Stats& stats) {
  if (close.pair.kind == NearKind::kParticleFace && in.garment->particle_area[close.pair.first] == 0.0f) {
    return;  // a vertex without a triangle is no part of the cloth
  }
  const auto& [a, b, c, d] = close.particle;
  rows.add({.particle = {a, b, c, d},
            .weight = {close.weight[0], close.weight[1], close.weight[2], close.weight[3]},
            .normal = close.normal,
            .offset = close.pair.distance,
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
  return garment != nullptr && position != nullptr && begin != nullptr && previous.x != nullptr &&
         inverse_mass != nullptr && pairs.pairs != nullptr && pairs.count != nullptr && friction >= 0.0f && dt > 0.0f &&
         contacts.count != nullptr;
}

void SelfDetection::run(Stats& stats) const {
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  run_wide(widest_vectors(), [&] {
    const SelfPairs all_pairs{*this};
    for_each_close_pair(pairs, all_pairs, [&](const ClosePair& close) { add_row(*this, close, rows, stats); });
  });
}

}  // namespace pleat
