// Cloths by layers: in which order they run, and what those above see of those below.
#pragma once

#include "engine/world.h"

namespace pleat {

/// The highest layer of any cloth.
std::uint32_t top_layer(const World& world);
/// Makes room for what layers keep, where a cloth has one. Throws std::bad_alloc.
void make_layer_room(World& world, const ClothRecord& cloth);
/// To be called when a tick begins, and for each cloth that has run in it.
void begin_layers(World& world);
void publish_layer(World& world, std::uint32_t cloth);
/// All layers look for what they touch anew: cloths came, went or were placed.
void forget_layer_pairs(World& world);

}  // namespace pleat
