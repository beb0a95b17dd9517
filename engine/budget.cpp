#include "engine/budget.h"

#include <algorithm>
#include <cmath>

#include "engine/run.h"
#include "engine/schedule.h"
#include "systems/detail_choice.h"

namespace pleat {
namespace {

constexpr float kOfTheNewest = 0.2f;  // in means: about ten ticks count
constexpr float kLeastShare = 0.01f;  // of the budget, for cloths that are seen

/// With so many substeps, and all else that it has.
ClothWork work_of(const ClothRecord& cloth, std::uint32_t substeps) {
  if (cloth.substeps_taken == 0) return {};  // asleep, or new
  const TessellationPattern* pattern = cloth.visible ? cloth.pattern() : nullptr;
  const bool folds = pattern != nullptr && has_folds_to_give(cloth);
  return {.particles = cloth.garment().particle_count,
          .substeps = substeps,
          .folds = folds ? cloth.garment().edge_count : 0,
          .drawn = pattern != nullptr ? pattern->vertex_count : 0};
}

/// What sleeps costs nothing, and keeps what it has: given back, and taken when it wakes, detail would come and go.
bool takes_part(const ClothRecord& cloth) { return cloth.visible && cloth.substeps_taken != 0; }

OfSteps work_by_steps(const ClothRecord& cloth) {
  return work_of(cloth, cloth.substeps_wanted).by_steps(has_substeps_to_give(cloth), has_ticks_to_give(cloth));
}

/// Of the last tick, with what had faded by then.
float work_taken(const World& world) {
  float sum = 0.0f;
  for (const ClothRecord& cloth : world.clothes) {
    ClothWork work = work_of(cloth, cloth.substeps_taken);
    if (cloth.fold_share == 0.0f) work.folds = 0;
    sum += cloth.carried ? work.of_carrying() : work.of_tick();
  }
  return sum;
}

void give_up(World& world, ClothRecord& cloth, std::uint32_t steps) {
  const std::uint32_t ticks = takes_one_tick_of(cloth);
  cloth.given_up = steps;
  if (takes_one_tick_of(cloth) != ticks) replan(world, cloth);
}

}  // namespace

void keep_budget(World& world, float budget_ms, float cost_ms) {
  if (budget_ms == 0.0f) {
    for (ClothRecord& cloth : world.clothes) give_up(world, cloth, 0);
    world.cost = world.work = world.scarcity = 0.0f;
    return;
  }
  world.detail.reserve(world.clothes.size());
  world.detail.resize(world.clothes.size());
  std::size_t count = 0;
  float unseen = 0.0f;  // work
  for (const ClothRecord& cloth : world.clothes) {
    const OfSteps work = work_by_steps(cloth);
    if (takes_part(cloth)) {
      world.detail[count++] = {cloth.importance, work, cloth.given_up};
    } else if (!cloth.visible) {
      unseen += work[kMostGivenUp];
    }
  }
  // Apart, for where cloths wait ticks differ.
  const float newest = world.work == 0.0f ? 1.0f : kOfTheNewest;
  world.cost += newest * (cost_ms - world.cost);
  world.work += newest * (work_taken(world) - world.work);
  const float pace = world.work > 0.0f ? world.cost / world.work : 0.0f;
  // What nobody sees has nothing to give, and takes its part.
  const float left = std::max(budget_ms - pace * unseen, kLeastShare * budget_ms);
  world.scarcity = run(DetailChoice{
      .candidates = {world.detail.data(), count}, .budget = left, .pace = pace, .scarcity = world.scarcity});
  count = 0;
  for (ClothRecord& cloth : world.clothes) {
    if (takes_part(cloth)) {
      give_up(world, cloth, world.detail[count++].given_up);
    } else if (!cloth.visible) {
      give_up(world, cloth, 0);
    }
  }
}

void fade_substeps(ClothRecord& cloth, float dt) {
  const bool yields = has_substeps_to_give(cloth);
  const float share = yields ? 1.0f / static_cast<float>(kSubstepsParted[steps_given_up(cloth)]) : 1.0f;
  cloth.substep_share = cloth.visible ? faded(cloth.substep_share, share, dt * kSubstepsFade) : share;
}

void fade_folds(World& world, ClothRecord& cloth, float dt) {
  const float folds = folds_wanted(cloth);
  if (cloth.fold_share == folds) return;
  cloth.fold_share = faded(cloth.fold_share, folds, dt * kFoldsFade);
  replan(world, cloth);
  if (cloth.fold_share == 0.0f) flatten_folds(world, cloth);
}

void flatten_folds(World& world, ClothRecord& cloth) {
  cloth.sides_known = false;
  if (world.surface.fold_height.size() == 0) return;
  std::fill_n(world.surface.fold_height.data() + cloth.edge_begin, cloth.garment().edge_count, 0.0f);
}

}  // namespace pleat
