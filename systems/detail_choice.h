// Which cloths give up detail so that a tick keeps to its time.
#pragma once

#include <span>

#include "components/detail.h"

namespace pleat {

/// What a tick of a cloth takes, in particles times substeps, by what systems take of the kick (bench/README.md).
/// folds, drawn: edges that fold, drawn vertices; shrinks: whether fewer substeps can be taken.
std::array<float, kMostGivenUp + 1> detail_work(std::uint32_t particles, std::uint32_t substeps, std::uint32_t folds,
                                                std::uint32_t drawn, bool shrinks);

/// The least important cloths give up all they have before the next give up anything; among equals the first. Where
/// the cloths with what they have now are expected to cost more than the budget, as many steps are given up as should
/// bring that to .95 of it; where less than .8 of it, as many are taken back as should keep it under .9. In between
/// nothing changes but that a cloth takes the place of one less than .8 times as important, so that measured times,
/// which waver, do not make detail flicker.
/// Reads:  budget ms; pace ms for a unit of work; importance and work of the candidates
/// Writes: given_up of the candidates; order (scratch, as many)
/// Cost:   O(n log n), no allocation. Errors: none; what cannot be kept is kept as nearly as possible.
struct DetailChoice {
  std::span<DetailCandidate> candidates;
  std::span<std::uint32_t> order;
  float budget = 0.0f, pace = 0.0f;

  bool validate() const;
  /// What a tick is expected to cost now, ms.
  float run() const;

 private:
  void exchange() const;
  float give_up(float expected) const;
  float take_back(float expected) const;
};

}  // namespace pleat
