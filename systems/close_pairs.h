// Which of a list of pairs of features touch, eight side by side: most do not, in most substeps.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "systems/closeness.h"
#include "systems/facing.h"

namespace pleat {

/// What became of eight pairs of a kind.
struct CloseOnes {
  std::uint32_t near = 0;    // a bit for each that is nearer than `most`, or on the wrong side: as below
  std::uint32_t passed = 0;  // they passed through each other in this substep: closeness() has to say where
  Lanes weight[4];
  Vec3Lanes normal;
};

/// Does to pairs that did not pass each other in this substep what closeness() would do: their sides become known,
/// or 0, and weights and normal are the same.
/// x: at the end of the substep; before(x): puts where they were when it began.
template <class Before>
PLEAT_KERNEL CloseOnes close_ones(NearKind kind, const Vec3Lanes (&x)[4], const Before& before, const Lanes& most,
                                  Lanes& side) {
  const FacingT<Lanes> at = facing(kind, x);
  const LaneMask unknown = ~at.over | (side == 0.0f);
  LaneMask passed{};
  if (any(unknown)) {
    Vec3Lanes begin[4];
    before(begin);
    passed = unknown & ((at.volume < 0.0f) ^ (facing(kind, begin).volume < 0.0f));
    const Lanes found = at.over ? (at.volume < 0.0f ? all(-1.0f) : all(1.0f)) : Lanes{};
    side = (unknown & ~passed) ? found : side;
  }
  CloseOnes out;
  out.normal = at.area * (side / sqrt(at.over ? at.area2 : all(1.0f)));
  Lanes distance{};
  for (std::size_t k = 0; k < 4; ++k) {
    out.weight[k] = at.weight[k];
    distance += at.weight[k] * dot(out.normal, x[k]);
  }
  out.passed = bits(passed);
  out.near = bits(at.over & ~passed & ~(distance > most));
  return out;
}

/// A pair of features that are nearer than twice what they keep, or on the wrong side.
struct ClosePair {
  const NearPair& pair;
  std::uint32_t particle[4];  // the corners, as Closeness has them, cloth-local
  const Vec4* now[4];         // where these are, m
  const Vec4* before[4];      // where they were when the substep began, m
  float weight[4];            // as those of Closeness
  Vec3 normal;

  Vec3 x(std::uint32_t k) const { return vector_of(*now[k]); }
  Vec3 was(std::uint32_t k) const { return vector_of(*before[k]); }
};

/// What a run of pairs of one kind and with one other cloth has in common.
struct PairColumns {
  std::array<const std::uint32_t*, 4> particle;  // of corners, by feature; [0]: null where the first is a particle
  std::array<const Vec4*, 4> now, before;        // m, of the cloth that a corner belongs to
};

/// The corners of eight pairs of a run, of which the last may be the same.
struct PairCorners {
  std::uint32_t particle[4][kLanes];

  PLEAT_KERNEL PairCorners(const PairColumns& columns, NearKind kind, const NearPair* first, std::uint32_t count) {
    const std::uint32_t from_first = kind == NearKind::kEdges ? 2 : 1;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const NearPair& pair = first[std::min(lane, count - 1)];
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t feature = k < from_first ? pair.first : pair.second;
        particle[k][lane] = columns.particle[k] != nullptr ? columns.particle[k][feature] : feature;
      }
    }
  }
};

/// look_at(ClosePair) for one of eight, if it is one.
template <class LookAt>
inline void look_at_one(const PairColumns& columns, const PairCorners& corners, const CloseOnes& close,
                        std::uint32_t lane, NearPair& pair, const LookAt& look_at) {
  ClosePair found{.pair = pair, .particle = {}, .now = {}, .before = {}, .weight = {}, .normal = {}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    found.particle[k] = corners.particle[k][lane];
    found.now[k] = columns.now[k] + found.particle[k], found.before[k] = columns.before[k] + found.particle[k];
  }
  if ((close.passed >> lane & 1) != 0) {
    const Vec3 x[4] = {found.x(0), found.x(1), found.x(2), found.x(3)};
    const Vec3 was[4] = {found.was(0), found.was(1), found.was(2), found.was(3)};
    Closeness at;
    if (!closeness(pair.kind, x, was, pair.side, at) || at.distance > 2.0f * pair.distance) return;
    std::copy(at.weight, at.weight + 4, found.weight);
    found.normal = at.normal;
  } else {
    for (std::uint32_t k = 0; k < 4; ++k) found.weight[k] = close.weight[k][lane];
    found.normal = {close.normal.x[lane], close.normal.y[lane], close.normal.z[lane]};
  }
  look_at(found);
}

/// Calls look_at(ClosePair) for those of the list, in its order. Pairs have
///   columns_of(pair)      PairColumns
template <class Pairs, class LookAt>
PLEAT_KERNEL void for_each_close_pair(const NearPairList& list, Pairs& pairs, const LookAt& look_at) {
  NearPair* const last = list.pairs + *list.count;
  for (NearPair* first = list.pairs; first != last;) {
    const NearKind kind = first->kind;
    const std::uint32_t cloth = first->cloth;
    const PairColumns columns = pairs.columns_of(*first);
    const auto alike = [&](const NearPair& p) PLEAT_KERNEL_LAMBDA { return p.kind == kind && p.cloth == cloth; };
    while (first != last && alike(*first)) {
      std::uint32_t count = 1;
      while (count < kLanes && first + count != last && alike(first[count])) ++count;
      const PairCorners corners(columns, kind, first, count);
      Lanes side, most;
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const NearPair& pair = first[std::min(lane, count - 1)];
        side[lane] = pair.side, most[lane] = 2.0f * pair.distance;
      }
      Vec3Lanes x[4];
      for (std::uint32_t k = 0; k < 4; ++k) x[k] = gather(columns.now[k], corners.particle[k]).vector;
      const auto before = [&](Vec3Lanes(&begin)[4]) PLEAT_KERNEL_LAMBDA {
        for (std::uint32_t k = 0; k < 4; ++k) begin[k] = gather(columns.before[k], corners.particle[k]).vector;
      };
      const CloseOnes close = close_ones(kind, x, before, most, side);
      for (std::uint32_t lane = 0; lane < count; ++lane) first[lane].side = side[lane];
      for (std::uint32_t left = (close.near | close.passed) & ((1u << count) - 1); left != 0; left &= left - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
        look_at_one(columns, corners, close, lane, first[lane], look_at);
      }
      first += count;
    }
  }
}

}  // namespace pleat
