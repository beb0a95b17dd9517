#include "systems/detail_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pleat {
namespace {

constexpr float kWorkOfFold = 0.25f, kWorkOfDrawn = 0.2f;  // in particles times substeps
constexpr float kAimFromAbove = 0.95f, kCheap = 0.8f, kAimFromBelow = 0.9f;
constexpr float kClearlyLess = 0.8f;  // times as important

}  // namespace

std::array<float, kMostGivenUp + 1> detail_work(std::uint32_t particles, std::uint32_t substeps, std::uint32_t folds,
                                                std::uint32_t drawn, bool shrinks) {
  const auto dynamics = [&](std::uint32_t share) {
    const std::uint32_t taken = shrinks && substeps != 0 ? std::max(substeps / share, 1u) : substeps;
    return static_cast<float>(particles) * static_cast<float>(taken);
  };
  const float surface = kWorkOfDrawn * static_cast<float>(drawn), folding = kWorkOfFold * static_cast<float>(folds);
  return {dynamics(1) + surface + folding, dynamics(1) + surface, dynamics(2) + surface, dynamics(3) + surface};
}

bool DetailChoice::validate() const {
  return order.size() == candidates.size() && std::isfinite(budget) && budget > 0.0f && std::isfinite(pace) &&
         pace >= 0.0f &&
         std::ranges::all_of(candidates, [](const DetailCandidate& c) { return c.given_up <= kMostGivenUp; });
}

float DetailChoice::run() const {
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [this](std::uint32_t i, std::uint32_t j) {
    const float a = candidates[i].importance, b = candidates[j].importance;
    return a != b ? a < b : i < j;
  });
  exchange();
  float work = 0.0f;
  for (const DetailCandidate& c : candidates) work += c.work_now();
  const float expected = pace * work;
  return expected > budget ? give_up(expected) : expected < kCheap * budget ? take_back(expected) : expected;
}

/// Whoever is clearly more important than another shall have given up no more.
void DetailChoice::exchange() const {
  for (std::size_t low = 0, high = order.size(); low < high;) {
    DetailCandidate& less = candidates[order[low]];
    DetailCandidate& more = candidates[order[high - 1]];
    if (less.importance >= kClearlyLess * more.importance) return;
    if (more.given_up == 0) {
      --high;
    } else if (less.given_up == kMostGivenUp) {
      ++low;
    } else {
      if (more.given_up > less.given_up) std::swap(more.given_up, less.given_up);
      ++low, --high;
    }
  }
}

float DetailChoice::give_up(float expected) const {
  for (const std::uint32_t i : order) {
    DetailCandidate& c = candidates[i];
    for (std::uint32_t step = c.given_up + 1; step <= kMostGivenUp; ++step) {
      if (expected <= kAimFromAbove * budget) return expected;
      if (c.work[step] >= c.work_now()) continue;
      expected -= pace * (c.work_now() - c.work[step]);
      c.given_up = step;
    }
  }
  return expected;
}

float DetailChoice::take_back(float expected) const {
  for (std::size_t k = order.size(); k-- > 0;) {
    DetailCandidate& c = candidates[order[k]];
    while (c.given_up > 0) {
      const float dearer = pace * (c.work[c.given_up - 1] - c.work_now());
      if (expected + dearer > kAimFromBelow * budget) return expected;
      expected += dearer;
      --c.given_up;
    }
  }
  return expected;
}

}  // namespace pleat
