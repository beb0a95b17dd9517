#include "engine/budget.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/schedule.h"
#include "systems/detail_choice.h"

namespace pleat {
namespace {

constexpr float kOfTheNewest = 0.2f;  // in the mean pace: about ten ticks count

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
  const std::size_t count = world.clothes.size();
  world.detail.reserve(count), world.detail_order.reserve(count);
  world.detail.resize(count), world.detail_order.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ClothRecord& cloth = world.clothes[i];
    world.detail[i] = {cloth.importance, work_of(cloth, cloth.substeps_wanted), cloth.given_up};
  }
  if (const float work = work_taken(world); work > 0.0f) {
    world.pace = world.pace == 0.0f ? cost_ms / work : world.pace + kOfTheNewest * (cost_ms / work - world.pace);
  }
  const DetailChoice choice{.candidates = {world.detail.data(), count},
                            .order = {world.detail_order.data(), count},
                            .budget = budget_ms,
                            .pace = world.pace};
  assert(choice.validate());
  choice.run();
  for (std::size_t i = 0; i < count; ++i) world.clothes[i].given_up = world.detail[i].given_up;
}

void fade_detail(World& world, ClothRecord& cloth, float dt) {
  const float substeps = gives_up_substeps(cloth) ? 1.0f / static_cast<float>(cloth.given_up) : 1.0f;
  cloth.substep_share = cloth.visible ? faded(cloth.substep_share, substeps, dt * kSubstepsFade) : kInvisibleSubsteps;
  const float folds = gives_up_folds(cloth) ? 0.0f : 1.0f;
  if (cloth.fold_share == folds) return;
  cloth.fold_share = faded(cloth.fold_share, folds, dt * kFoldsFade);
  replan(world, cloth);
  if (cloth.fold_share == 0.0f && world.surface.fold_height.size() != 0) {  // nothing will draw or change them
    std::fill_n(world.surface.fold_height.data() + cloth.edge_begin, cloth.garment().edge_count, 0.0f);
  }
}

}  // namespace pleat
