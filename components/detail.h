// What a cloth can give up where a tick takes too long.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace pleat {

/// Steps of detail, each with those before it: 1 no folds, 2 half of the substeps, 3 a third of them.
inline constexpr std::uint32_t kMostGivenUp = 3;

struct DetailCandidate {
  float importance = 1.0f;                        // >= 0; any unit, the same for all
  std::array<float, kMostGivenUp + 1> work = {};  // what a tick takes with 0 .. 3 steps given up; any unit
  std::uint32_t given_up = 0;                     // steps

  float work_now() const { return work[given_up]; }
};

/// How fast detail goes and comes, 1/s: shares of the folds' height, of the substeps.
inline constexpr float kFoldsFade = 4.0f, kSubstepsFade = 0.5f;

/// A share on its way to `target`, by `most` at most.
inline float faded(float share, float target, float most) { return share + std::clamp(target - share, -most, most); }

}  // namespace pleat
