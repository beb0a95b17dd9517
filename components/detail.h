// What a cloth can give up where a tick takes too long.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace pleat {

/// Steps of detail, each with those before it: 1 no folds; 2 half of the substeps, 3 a third, 4 a quarter of them; and
/// from 5 on only one of two, four, eight ticks: in the others the cloth goes rigidly with its pins.
inline constexpr std::uint32_t kMostGivenUp = 7;
using OfSteps = std::array<float, kMostGivenUp + 1>;  // a number for each, from 0 on

inline constexpr std::array<std::uint32_t, kMostGivenUp + 1> kSubstepsParted = {1, 1, 2, 3, 4, 4, 4, 4};
inline constexpr std::array<std::uint32_t, kMostGivenUp + 1> kTicksParted = {1, 1, 1, 1, 1, 2, 4, 8};
/// From this step on bodies may move twice as far in a substep.
inline constexpr std::uint32_t kRoughContact = 4;

/// How much each step takes from what is seen of a cloth, against the others.
inline constexpr OfSteps kLoss = {0, 1, 1.5f, 2, 4, 12, 24, 48};

struct DetailCandidate {
  float importance = 1.0f;     // >= 0; any unit, the same for all
  OfSteps work = {};           // what a tick takes on average with so many steps given up; any unit
  std::uint32_t given_up = 0;  // steps
};

/// How fast detail goes and comes, 1/s: shares of the folds' height, of the substeps.
inline constexpr float kFoldsFade = 4.0f, kSubstepsFade = 0.5f;

/// A share on its way to `target`, by `most` at most.
inline float faded(float share, float target, float most) { return share + std::clamp(target - share, -most, most); }

}  // namespace pleat
