// Level of detail: what cloths give up for a tick to keep to its time.
#pragma once

#include "engine/world.h"

namespace pleat {

/// Chooses anew, after a tick that took cost_ms; budget_ms = 0: nothing is given up. Throws std::bad_alloc, and nothing
/// has changed, only when there are more cloths than ever before.
void keep_budget(World& world, float budget_ms, float cost_ms);

/// Brings the cloth nearer to what it may have, and plans anew where folds come or go. On any thread.
void fade_folds(World& world, ClothRecord& cloth, float dt);
/// The same of its substeps, which comes to nothing while it sleeps, but goes on.
void fade_substeps(ClothRecord& cloth, float dt);

inline bool has_folds_to_give(const ClothRecord& cloth) {
  return cloth.settings.surface == PLEAT_SURFACE_PLEAT && cloth.pattern() != nullptr;
}
inline bool gives_up_folds(const ClothRecord& cloth) { return cloth.given_up > 0 && has_folds_to_give(cloth); }
inline bool gives_up_substeps(const ClothRecord& cloth) { return cloth.given_up > 1 && cloth.settings.substeps == 0; }

/// Of its substeps, what a cloth takes that nobody sees.
inline constexpr float kInvisibleSubsteps = 1.0f / 6;

}  // namespace pleat
