// Jumps of the pins: of a cloth whose character was placed elsewhere.
#pragma once

#include "engine/schedule_table.h"

namespace pleat {

/// Carries the cloth where the host has declared a jump for this tick, or where its pins show one, and bodies with it.
void teleport(ClothTick& t);

}  // namespace pleat
