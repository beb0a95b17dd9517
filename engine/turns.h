// Ticks that a cloth does without, in which it goes rigidly with its pins.
#pragma once

#include <optional>

#include "engine/schedule_table.h"

namespace pleat {

/// How far bodies go against the cloth in this tick, in substeps with such a reach (see SubstepBound). carry: against
/// the cloth that is carried so.
float travel_of_bodies(const ClothTick& t, float reach, const std::optional<RigidMotion>& carry = {});

/// Whether the cloth does without this tick. Cloths that take one of two, four or eight take turns, so that all ticks
/// are about as long, and take one at once where bodies would have gone too far against them. To be asked once a tick.
bool waits(ClothTick& t);

/// Takes the cloth to where its pins shall be at the tick's end, as it is: it must have pins. What it remembers by
/// place is forgotten.
void carry_with_pins(ClothTick& t);
/// What is drawn goes the same way.
void carry_surface(ClothTick& t);

}  // namespace pleat
