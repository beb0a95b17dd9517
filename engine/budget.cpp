#include "engine/budget.h"

#include <algorithm>
#include <cmath>

#include "engine/run.h"
#include "engine/schedule.h"
#include "systems/detail_choice.h"

namespace pleat {
namespace {

constexpr float kOfTheNewest = 0.2f;  // in the mean pace: about ten ticks count
constexpr float kLeastShare = 0.01f;  // of the budget, for cloths that are seen

using Work = std::array<float, kMostGivenUp + 1>;

Work work_of(const ClothRecord& cloth, std::uint32_t substeps) {
  const Garment& g = cloth.garment();
  const TessellationPattern* pattern = cloth.pattern();
  if (cloth.substeps_taken == 0) return {};  // asleep, or new
  if (!cloth.visible) return detail_work(g.particle_count, cloth.substeps_taken, 0, 0, false);
  return detail_work(g.particle_count, substeps, has_folds_to_give(cloth) ? g.edge_count : 0,
                     pattern != nullptr ? pattern->vertex_count : 0, cloth.settings.substeps == 0);
}

/// Of the last tick, with what had faded by then.
float work_taken(const World& world) {
  float sum = 0.0f;
  for (const ClothRecord& cloth : world.clothes) {
    sum += work_of(cloth, cloth.substeps_taken)[cloth.fold_share == 0.0f ? 1 : 0];
  }
  return sum;
}

}  // namespace

void keep_budget(World& world, float budget_ms, float cost_ms) {
  if (budget_ms == 0.0f) {
    for (ClothRecord& cloth : world.clothes) cloth.given_up = 0;
    world.pace = 0.0f;
    return;
  }
  const std::size_t most = world.clothes.size();
  world.detail.reserve(most), world.detail_order.reserve(most);
  world.detail.resize(most), world.detail_order.resize(most);
  std::size_t count = 0;
  float unseen = 0.0f;  // work
  for (const ClothRecord& cloth : world.clothes) {
    const Work work = work_of(cloth, cloth.substeps_wanted);
    if (cloth.visible) {
      world.detail[count++] = {cloth.importance, work, cloth.given_up};
    } else {
      unseen += work[0];
    }
  }
  if (const float work = work_taken(world); work > 0.0f) {
    world.pace = world.pace == 0.0f ? cost_ms / work : world.pace + kOfTheNewest * (cost_ms / work - world.pace);
  }
  // What nobody sees has nothing to give, and takes its part.
  const float left = std::max(budget_ms - world.pace * unseen, kLeastShare * budget_ms);
  run(DetailChoice{.candidates = {world.detail.data(), count},
                   .order = {world.detail_order.data(), count},
                   .budget = left,
                   .pace = world.pace});
  count = 0;
  for (ClothRecord& cloth : world.clothes) cloth.given_up = cloth.visible ? world.detail[count++].given_up : 0;
}

void fade_substeps(ClothRecord& cloth, float dt) {
  const float substeps = gives_up_substeps(cloth) ? 1.0f / static_cast<float>(cloth.given_up) : 1.0f;
  cloth.substep_share = cloth.visible ? faded(cloth.substep_share, substeps, dt * kSubstepsFade) : kInvisibleSubsteps;
}

void fade_folds(World& world, ClothRecord& cloth, float dt) {
  const float folds = gives_up_folds(cloth) ? 0.0f : 1.0f;
  if (cloth.fold_share == folds) return;
  cloth.fold_share = faded(cloth.fold_share, folds, dt * kFoldsFade);
  replan(world, cloth);
  if (cloth.fold_share == 0.0f && world.surface.fold_height.size() != 0) {  // nothing will draw or change them
    std::fill_n(world.surface.fold_height.data() + cloth.edge_begin, cloth.garment().edge_count, 0.0f);
  }
}

}  // namespace pleat
