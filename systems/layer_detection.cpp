#include "systems/layer_detection.h"

#include "systems/close_pairs.h"
#include "systems/contact_row.h"
#include "systems/near_search.h"

namespace pleat {
namespace {

/// Of the four corners of a pair, the cloth's own; the others are the other cloth's.
bool is_own(NearKind kind, std::uint32_t k) {
  return kind == NearKind::kEdges ? k < 2 : (k == 0) == (kind == NearKind::kParticleFace);
}

/// LayerCloth::at of all its particles.
PLEAT_KERNEL void pose(const LayerCloth& cloth, float t, const Vec3& origin, Vec4* to) {
  const Vec3Lanes apart = all(cloth.origin - origin);
  for (std::size_t i = 0; i < cloth.garment->particle_count; i += kLanes) {
    const Vec3Lanes from = load(cloth.begin, i);
    pack(from + (load(cloth.end, i) - from) * all(t) + apart, Lanes{}, to + i);
  }
}

/// The pairs of one cloth with those below it, for for_each_close_pair, which has those with a cloth after each other.
struct LayerPairs {
  const LayerDetection& in;
  std::uint32_t posed = kNone;  // the other cloth that is in the scratch

  PLEAT_KERNEL PairColumns columns_of(const NearPair& pair) {
    const LayerCloth& cloth = in.clothes[pair.cloth];
    if (pair.cloth != posed) {
      pose(cloth, in.t1, in.origin, in.scratch->other.data());
      pose(cloth, in.t0, in.origin, in.scratch->other_begin.data());
      posed = pair.cloth;
    }
    const Garment &own = *in.garment, &other = *cloth.garment;
    const auto& corner = (pair.kind == NearKind::kOtherParticleFace ? own : other).face_particle;
    PairColumns columns{{nullptr, corner[0].data(), corner[1].data(), corner[2].data()}, {}, {}};
    if (pair.kind == NearKind::kEdges) {
      const auto &a = own.edge_particle, &b = other.edge_particle;
      columns.particle = {a[0].data(), a[1].data(), b[0].data(), b[1].data()};
    }
    for (std::uint32_t k = 0; k < 4; ++k) {
      const bool ours = is_own(pair.kind, k);
      columns.now[k] = ours ? in.position : in.scratch->other.data();
      columns.before[k] = ours ? in.begin : in.scratch->other_begin.data();
    }
    return columns;
  }
};

void add_row(const LayerDetection& in, const ClosePair& close, const ContactRowMaker& rows, Stats& stats) {
  const NearPair& pair = close.pair;
  if (pair.kind == NearKind::kOtherParticleFace && in.clothes[pair.cloth].garment->particle_area[pair.first] == 0.0f) {
    return;
  }
  const float sign = is_own(pair.kind, 0) ? 1.0f : -1.0f;  // so that the weights of the own feature sum to 1
  ContactRow row{.particle = {},
                 .weight = {},
                 .normal = close.normal * sign,
                 .offset = pair.distance,
                 .body_step = {},
                 .friction = in.friction,
                 .share = {},
                 .count = 0,
                 .push = 0.0f,
                 .rubbed = 0.0f};
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (is_own(pair.kind, k)) {
      row.particle[row.count] = close.particle[k];
      row.weight[row.count++] = sign * close.weight[k];
    } else {
      row.offset -= close.weight[k] * dot(close.normal, close.x(k));
      row.body_step += (close.x(k) - close.was(k)) * (-sign * close.weight[k]);
    }
  }
  rows.add(row, stats);
}

}  // namespace

bool LayerDetection::validate() const {
  return garment != nullptr && position != nullptr && begin != nullptr && previous.x != nullptr &&
         inverse_mass != nullptr && t0 < t1 && pairs.pairs != nullptr && pairs.count != nullptr && friction >= 0.0f &&
         dt > 0.0f && scratch != nullptr && holds_all(*scratch, clothes) && contacts.count != nullptr;
}

void LayerDetection::run(Stats& stats) const {
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  run_wide(widest_vectors(), [&] {
    LayerPairs all_pairs{*this};
    for_each_close_pair(pairs, all_pairs, [&](const ClosePair& close) { add_row(*this, close, rows, stats); });
  });
}

}  // namespace pleat
