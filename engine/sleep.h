// Cloths at rest: when they fall asleep, and what wakes them.
#pragma once

#include "engine/schedule_table.h"

namespace pleat {

/// Something that a cloth depends on has changed; `wake_all`: that all may depend on.
void wake(ClothRecord& cloth);
void wake_all(World& world);
/// A body in these groups is another than it was, or there no more.
void wake_who_meets(World& world, std::uint32_t groups);
/// Whether the cloth has nothing to do in this tick: to be asked before it, with the tick's poses in place.
bool sleeps_on(const ClothTick& t);
/// Before a jump takes bodies along, which then have not moved: what sleeps where one leaves or arrives wakes.
void wake_around_bodies(World& world, Worker& worker);
/// In a tick that the cloth does without: what would have disturbed it wakes it all the same.
void stir(ClothTick& t);
/// When a tick is done: a cloth that was calm for long enough falls asleep.
void watch_rest(ClothTick& t);

}  // namespace pleat
