#include "systems/layer_detection.h"

#include <array>

#include "systems/close_pairs.h"
#include "systems/closeness.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// The pairs of one cloth with those below it, for for_each_close_pair.
struct LayerPairs {
  const LayerDetection& in;

  /// Of the four corners of a pair, the cloth's own; the others are the other cloth's.
  static bool is_own(NearKind kind, std::uint32_t k) {
    return kind == NearKind::kEdges ? k < 2 : (k == 0) == (kind == NearKind::kParticleFace);
  }
  std::array<std::uint32_t, 4> corners_of(const NearPair& pair) const {
    const Garment &own = *in.garment, &other = *in.clothes[pair.cloth].garment;
    if (pair.kind == NearKind::kEdges) {
      const auto &a = own.edge_particle, &b = other.edge_particle;
      return {a[0][pair.first], a[1][pair.first], b[0][pair.second], b[1][pair.second]};
    }
    const auto& face = (pair.kind == NearKind::kOtherParticleFace ? own : other).face_particle;
    return {pair.first, face[0][pair.second], face[1][pair.second], face[2][pair.second]};
  }
  PLEAT_KERNEL Vec3Lanes end(const NearPair& pair, std::uint32_t k, const std::uint32_t* index) const {
    return is_own(pair.kind, k) ? gather(in.position, index) : others(in.clothes[pair.cloth], in.t1, index);
  }
  PLEAT_KERNEL Vec3Lanes begin(const NearPair& pair, std::uint32_t k, const std::uint32_t* index) const {
    return is_own(pair.kind, k) ? gather(in.previous, index) : others(in.clothes[pair.cloth], in.t0, index);
  }

 private:
  /// LayerCloth::at, of eight.
  PLEAT_KERNEL Vec3Lanes others(const LayerCloth& cloth, float t, const std::uint32_t* index) const {
    const Vec3Lanes from = gather(cloth.begin, index), to = gather(cloth.end, index);
    return from + (to - from) * all(t) + all(cloth.origin - in.origin);
  }
};

void add_row(const LayerDetection& in, NearPair& pair, const ContactRowMaker& rows, Stats& stats) {
  const LayerCloth& other = in.clothes[pair.cloth];
  if (pair.kind == NearKind::kOtherParticleFace && other.garment->particle_area[pair.first] == 0.0f) return;
  const std::array<std::uint32_t, 4> corner = LayerPairs{in}.corners_of(pair);
  const auto is_own = [&](std::uint32_t k) { return LayerPairs::is_own(pair.kind, k); };
  Vec3 x[4], before[4];
  for (std::uint32_t k = 0; k < 4; ++k) {
    x[k] = is_own(k) ? in.position[corner[k]] : other.at(corner[k], in.t1, in.origin);
    before[k] = is_own(k) ? in.previous[corner[k]] : other.at(corner[k], in.t0, in.origin);
  }
  Closeness near;
  if (!closeness(pair.kind, x, before, pair.side, near) || near.distance > 2.0f * pair.distance) return;

  const float sign = is_own(0) ? 1.0f : -1.0f;  // so that the weights of the own feature sum to 1
  ContactRow row{.particle = {},
                 .weight = {},
                 .normal = near.normal * sign,
                 .offset = pair.distance,
                 .body_step = {},
                 .friction = in.friction,
                 .share = {},
                 .count = 0,
                 .push = 0.0f,
                 .rubbed = 0.0f};
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (is_own(k)) {
      row.particle[row.count] = corner[k];
      row.weight[row.count++] = sign * near.weight[k];
    } else {
      row.offset -= near.weight[k] * dot(near.normal, x[k]);
      row.body_step += (x[k] - before[k]) * (-sign * near.weight[k]);
    }
  }
  rows.add(row, stats);
}

}  // namespace

bool LayerDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr && t0 < t1 &&
         pairs.pairs != nullptr && pairs.count != nullptr && friction >= 0.0f && dt > 0.0f && contacts.count != nullptr;
}

void LayerDetection::run(Stats& stats) const {
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  run_wide(widest_vectors(), [&] {
    for_each_close_pair(pairs, LayerPairs{*this}, [&](NearPair& pair) { add_row(*this, pair, rows, stats); });
  });
}

}  // namespace pleat
