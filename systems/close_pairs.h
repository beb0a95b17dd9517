// Which of a list of pairs of features come close, eight side by side: most do not, in most substeps.
#pragma once

#include <algorithm>
#include <bit>

#include "systems/facing.h"

namespace pleat {

/// A bit for each of eight pairs of a kind that closeness() has to look at: they pass through each other in this
/// substep, or are nearer than `most`. To the others it does what closeness() would do: their sides become known, or 0.
/// x: at the end of the substep; before(x): puts where they were when it began.
template <class Before>
PLEAT_KERNEL std::uint32_t close_ones(NearKind kind, const Vec3Lanes (&x)[4], const Before& before, const Lanes& most,
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
  const Vec3Lanes normal = at.area * (side / sqrt(at.over ? at.area2 : all(1.0f)));
  Lanes distance{};
  for (std::size_t k = 0; k < 4; ++k) distance += at.weight[k] * dot(normal, x[k]);
  return bits(passed | (at.over & ~(distance > most)));
}

/// Calls look_at(pair, corners) for those pairs of the list, in its order. Pairs have
///   corners_of(pair)                   the four particles, as closeness() has the points
///   end(pair, k, index), begin(...)    where the k-th of eight pairs like that one are and were, Vec3Lanes
template <class Pairs, class LookAt>
PLEAT_KERNEL void for_each_close_pair(const NearPairList& list, const Pairs& pairs, const LookAt& look_at) {
  NearPair* const last = list.pairs + *list.count;
  for (NearPair* first = list.pairs; first != last;) {
    const auto alike = [&](const NearPair& p) { return p.kind == first->kind && p.cloth == first->cloth; };
    std::uint32_t count = 1;
    while (count < kLanes && first + count != last && alike(first[count])) ++count;

    std::uint32_t corner[4][kLanes];
    Lanes side, most;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const NearPair& pair = first[std::min(lane, count - 1)];
      const auto corners = pairs.corners_of(pair);
      for (std::size_t k = 0; k < 4; ++k) corner[k][lane] = corners[k];
      side[lane] = pair.side, most[lane] = 2.0f * pair.distance;
    }
    Vec3Lanes x[4];
    for (std::uint32_t k = 0; k < 4; ++k) x[k] = pairs.end(*first, k, corner[k]);
    const auto before = [&](Vec3Lanes(&begin)[4]) PLEAT_KERNEL_LAMBDA {
      for (std::uint32_t k = 0; k < 4; ++k) begin[k] = pairs.begin(*first, k, corner[k]);
    };
    std::uint32_t close = close_ones(first->kind, x, before, most, side) & ((1u << count) - 1);
    for (std::uint32_t lane = 0; lane < count; ++lane) first[lane].side = side[lane];
    for (; close != 0; close &= close - 1) look_at(first[std::countr_zero(close)]);
    first += count;
  }
}

}  // namespace pleat
