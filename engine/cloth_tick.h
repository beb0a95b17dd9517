// One cloth through one tick: how many substeps, and what happens when they go wrong.
#pragma once

#include "engine/schedule_table.h"

namespace pleat {

/// Of a tick that goes well.
inline constexpr std::uint32_t kMostSubsteps = 64;

/// Runs the rows of a phase that are in the cloth's plan.
void run_phase(ClothTick& t, Phase phase);
/// Advances the cloth by dt seconds, on any thread: it changes nothing but the cloth and the worker. A tick that ends
/// badly (rows of the phase `check`) begins anew with twice the substeps, twice at most; then the cloth stays as it
/// was.
void tick_cloth(World& world, Worker& worker, ClothRecord& cloth, float dt);
/// Logs what went wrong in it, each once: by the thread that steps the world.
void report_troubles(const World& world, ClothRecord& cloth);

}  // namespace pleat
