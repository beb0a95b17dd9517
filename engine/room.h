// Memory for what only some settings and scenes use.
#pragma once

#include "engine/world.h"

namespace pleat {

/// Makes room for the optional columns that `cloth` uses, and for the scratch of its ticks. Throws std::bad_alloc.
void make_room(World& world, const ClothRecord& cloth);

}  // namespace pleat
