// Ever fewer of a garment's particles, through which a pull travels far in one pass.
//   M. Mueller, "Hierarchical Position Based Dynamics", 2008.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "components/edge_slots.h"
#include "components/tethers.h"

namespace pleat {

struct Garment;

/// As many edges away from a pin a garment has coarse levels. One of half that depth trembles between limbs that cross
/// where passes pull too far.
inline constexpr std::uint32_t kCoarseDepth = 2 * kSweepReach;
inline constexpr std::size_t kParents = 3;

/// About a quarter of the particles of the next finer level, none of them neighbours there. Edges join those whose
/// neighbourhoods meet, as long as the shortest way over one finer edge between these: no shorter than along the
/// garment's own edges, so that they say nothing which those do not say together. Children (C, padded with empty places
/// of weight 0) are the finer level's other particles, but for pins; each has parents beside it, with weights that add
/// up to 1.
struct CoarseLevel {
  EdgeSlots slots;
  std::uint32_t way_begin = 0;  // where those of its slots are among the garment's ways
  Column<std::uint32_t> child, parent[kParents];
  Column<float> weight[kParents];

  explicit CoarseLevel(std::pmr::memory_resource* m)
      : slots(m),
        child(m),
        parent{Column<std::uint32_t>(m), Column<std::uint32_t>(m), Column<std::uint32_t>(m)},
        weight{Column<float>(m), Column<float>(m), Column<float>(m)} {}
};

/// Fills the garment's levels, the coarsest first, and counts its ways. The garment has its edges, slots and pins.
/// There are levels as long as some particle is kCoarseDepth edges from these; without pins none, for cloth that lies
/// on something is held all over, and with levels trembled more there. Cost: O(E log E). Throws std::bad_alloc.
void add_coarse_levels(Garment& garment);

}  // namespace pleat
