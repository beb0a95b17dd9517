// Level of detail: what cloths give up for a tick to keep to its time, and those that nobody sees anyway.
#pragma once

#include "engine/world.h"

namespace pleat {

/// Of a cloth, as the host may set it.
inline constexpr float kMostImportance = 1e30f;

/// Chooses anew, after a tick that took cost_ms; budget_ms = 0: nothing is given up. Throws std::bad_alloc, and nothing
/// has changed, only when there are more cloths than ever before.
void keep_budget(World& world, float budget_ms, float cost_ms);

/// Brings the cloth nearer to what it may have, and plans anew where folds come or go. On any thread.
void fade_folds(World& world, ClothRecord& cloth, float dt);
/// The same of its substeps, which comes to nothing while it sleeps, but goes on.
void fade_substeps(ClothRecord& cloth, float dt);

/// Steps of detail that the cloth does without.
inline std::uint32_t steps_given_up(const ClothRecord& cloth) { return cloth.visible ? cloth.given_up : kMostGivenUp; }

inline bool has_folds_to_give(const ClothRecord& cloth) {
  return cloth.settings.surface == PLEAT_SURFACE_PLEAT && cloth.pattern() != nullptr;
}
inline bool gives_up_folds(const ClothRecord& cloth) { return cloth.given_up > 0 && has_folds_to_give(cloth); }
/// Where its fold_share goes.
inline float folds_wanted(const ClothRecord& cloth) { return gives_up_folds(cloth) ? 0.0f : 1.0f; }
/// Folds come or go where it is seen.
inline bool shows_fading(const ClothRecord& cloth) { return cloth.visible && cloth.fold_share != folds_wanted(cloth); }
/// Where folds are given up their height is none, which tessellation relies on; when they come back they choose anew.
void flatten_folds(World& world, ClothRecord& cloth);

inline bool has_substeps_to_give(const ClothRecord& cloth) { return cloth.settings.substeps == 0; }
inline bool gives_up_substeps(const ClothRecord& cloth) {
  return kSubstepsParted[cloth.given_up] > 1 && has_substeps_to_give(cloth);
}

/// Layers would miss each other, and what has no pins would stop in the air.
inline bool has_ticks_to_give(const ClothRecord& cloth) {
  return has_substeps_to_give(cloth) && cloth.settings.layer == 0 && cloth.garment().pins.size() != 0;
}
/// The cloth takes one of so many ticks.
inline std::uint32_t takes_one_tick_of(const ClothRecord& cloth) {
  return has_ticks_to_give(cloth) ? kTicksParted[steps_given_up(cloth)] : 1;
}

}  // namespace pleat
