// Where the zero of a cloth's positions is.
// A float resolves .06 mm one kilometre from zero, and cloth moves by less in a substep: far out it would tremble, and
// then stand still. So the positions of a cloth, of its pins and of all that remembers where they were count from a
// place near it, and bodies are seen from there. The host's own numbers are of the world.
#pragma once

#include "engine/world.h"

namespace pleat {

/// What of a way or a place is whole cells of 8 m; 0 up to one.
Vec3 whole_cells(const Vec3& a);

/// Moves the cloth's origin to where the cloth is, if it is more than 8 m away from it: by whole multiples of 8 m, so
/// that no position loses a digit. Follows the first pin's next place or, where that holds
/// no cloth, a particle in the middle.
void recentre(World& world, ClothRecord& cloth);

}  // namespace pleat
