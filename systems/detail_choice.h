// Which cloths give up detail so that a tick keeps to its time.
//   T. A. Funkhouser and C. H. Sequin, "Adaptive Display Algorithm for Interactive Frame Rates During Visualization of
//   Complex Virtual Environments", 1993: detail goes where it is worth the most.
#pragma once

#include <span>

#include "components/detail.h"

namespace pleat {

/// What makes a tick of a cloth long.
struct ClothWork {
  std::uint32_t particles = 0, substeps = 0;
  std::uint32_t folds = 0, drawn = 0;  // edges that fold, drawn vertices

  /// In particles times substeps, by what systems take of the kick (bench/README.md).
  float of_tick() const;
  /// Of one in which the cloth only goes with its pins.
  float of_carrying() const;
  /// Of a tick on average with 0, 1 .. steps given up. yields: whether fewer substeps can be taken; waits: and ticks.
  OfSteps by_steps(bool yields, bool waits) const;
};

/// A cloth gives up a step of detail where time is so scarce that scarcity >= loss of the step * importance, and takes
/// it back below .8 of that. Among equals the first give up first; importance counts as a millionth of the largest at
/// least. Where the cloths with what they have now are expected to cost more than the budget, scarcity rises until that
/// is .95 of it; where less than .8 of it, it falls as far as that stays under .9. In between only importance changes
/// anything, so that measured times, which waver, do not make detail flicker.
/// Reads:  budget ms; pace ms for a unit of work; scarcity as it was; importance and work of the candidates
/// Writes: given_up of the candidates
/// Cost:   O(n), no allocation. Errors: none; what cannot be kept is kept as nearly as possible.
struct DetailChoice {
  std::span<DetailCandidate> candidates;
  float budget = 0.0f, pace = 0.0f, scarcity = 0.0f;

  bool validate() const;
  /// How scarce time is from now on, in the unit of importance; 0 where nothing is given up.
  float run() const;

 private:
  float largest_importance() const;
  std::uint32_t step_at(std::size_t candidate, float scarce, float largest) const;
  /// What a tick should cost then, ms.
  float expected_at(float scarce, float largest) const;
  float least_that_keeps(float share_of_budget, float low, float high, float largest) const;
};

}  // namespace pleat
