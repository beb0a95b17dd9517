// Ticks that a cloth does without, in which it goes rigidly with its pins; and how far bodies go against cloth in one.
#pragma once

#include <optional>

#include "engine/schedule_table.h"

namespace pleat {

/// How far bodies go against the cloth in this tick, in substeps with such a reach (see SubstepBound). carry: against
/// the cloth that is carried so.
float travel_of_bodies(const ClothTick& t, float reach, const std::optional<RigidMotion>& carry = {});

/// At the begin of each tick: says who waits in it. Those that take one of two, of four, of eight ticks take turns,
/// each among themselves, so that all ticks are about as long.
void begin_turns(World& world);
/// Whether the cloth does without this tick, which it takes after all where bodies would have gone too far against it.
/// To be asked once a tick.
bool waits(ClothTick& t);

/// Takes the cloth as it is along t.carry, and its pins to where they shall be. What it remembers by place is
/// forgotten.
void carry_with_pins(ClothTick& t);
#ifdef PLEAT_WITH_SMOOTHING
/// What is drawn goes the same way.
void carry_surface(ClothTick& t);
#endif

}  // namespace pleat
