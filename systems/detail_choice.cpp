#include "systems/detail_choice.h"

#include <algorithm>
#include <cmath>

namespace pleat {
namespace {

constexpr float kWorkOfFold = 0.25f, kWorkOfDrawn = 0.2f, kWorkOfCarrying = 0.02f;  // in particles times substeps
constexpr float kAimFromAbove = 0.95f, kCheap = 0.8f, kAimFromBelow = 0.9f;         // of the budget
constexpr float kClearlyLess = 0.8f;  // of the scarcity at which a step was given up
constexpr float kLeast = 1e-6f;       // of the largest importance, that any counts
constexpr float kEarlier = 0.2f;      // how much less important the first of equals counts than the last
constexpr float kFine = 1e-4f;        // of scarcity, to which it is found

/// The most steps whose loss is no more than `most`.
std::uint32_t steps_within(float most) {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(kLoss, most) - kLoss.begin()) - 1;
}

}  // namespace

float ClothWork::of_tick() const {
  return static_cast<float>(particles) * static_cast<float>(substeps) + kWorkOfFold * static_cast<float>(folds) +
         kWorkOfDrawn * static_cast<float>(drawn);
}

float ClothWork::of_carrying() const { return kWorkOfCarrying * static_cast<float>(particles + drawn); }

OfSteps ClothWork::by_steps(bool yields, bool waits) const {
  OfSteps work{};
  for (std::uint32_t step = 0; step <= kMostGivenUp; ++step) {
    ClothWork left = *this;
    if (step != 0) left.folds = 0;
    if (yields && substeps != 0) left.substeps = std::max(substeps / kSubstepsParted[step], 1u);
    const float taken = waits ? 1.0f / static_cast<float>(kTicksParted[step]) : 1.0f;
    work[step] = taken * left.of_tick() + (1.0f - taken) * left.of_carrying();
  }
  return work;
}

bool DetailChoice::validate() const {
  return std::isfinite(budget) && budget > 0.0f && std::isfinite(pace) && pace >= 0.0f && std::isfinite(scarcity) &&
         scarcity >= 0.0f && std::ranges::all_of(candidates, [](const DetailCandidate& c) {
           return c.given_up <= kMostGivenUp && std::isfinite(c.importance) && c.importance >= 0.0f;
         });
}

/// 1 where nothing has any.
float DetailChoice::largest_importance() const {
  float largest = 0.0f;
  for (const DetailCandidate& c : candidates) largest = std::max(largest, c.importance);
  return largest > 0.0f ? largest : 1.0f;
}

std::uint32_t DetailChoice::step_at(std::size_t candidate, float scarce, float largest) const {
  const DetailCandidate& c = candidates[candidate];
  const float place = static_cast<float>(candidate) / static_cast<float>(candidates.size());
  const float counts = std::max(c.importance, kLeast * largest) * (1.0f - kEarlier * (1.0f - place));
  return std::clamp(c.given_up, steps_within(scarce / counts), steps_within(scarce / (kClearlyLess * counts)));
}

float DetailChoice::expected_at(float scarce, float largest) const {
  float work = 0.0f;
  for (std::size_t i = 0; i < candidates.size(); ++i) work += candidates[i].work[step_at(i, scarce, largest)];
  return pace * work;
}

/// Not at `low`, but at `high`.
float DetailChoice::least_that_keeps(float share_of_budget, float low, float high, float largest) const {
  while (high - low > kFine * high) {
    const float middle = 0.5f * (low + high);
    (expected_at(middle, largest) <= share_of_budget * budget ? high : low) = middle;
  }
  return high;
}

float DetailChoice::run() const {
  const float largest = largest_importance();
  const float most = kLoss.back() * largest;  // at which all is given up
  float scarce = std::min(scarcity, most);
  if (const float expected = expected_at(scarce, largest); expected > budget) {
    scarce = least_that_keeps(kAimFromAbove, scarce, most, largest);
  } else if (expected < kCheap * budget) {
    const bool plenty = expected_at(0.0f, largest) <= kAimFromBelow * budget;
    scarce = plenty ? 0.0f : least_that_keeps(kAimFromBelow, 0.0f, scarce, largest);
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].given_up = step_at(i, scarce, largest);
  return scarce;
}

}  // namespace pleat
