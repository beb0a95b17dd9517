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
/// The cloth goes, was placed elsewhere or changes its layer: what is between it and others is forgotten, and those
/// that may lie on it wake.
void forget_layer_pairs(World& world, ClothRecord& cloth);
/// Before the cloth at `position` goes: those behind it will be one place further ahead.
void renumber_layer_pairs(World& world, std::uint32_t position);

}  // namespace pleat
