// Edges in the places in which they are solved.
#pragma once

#include <cstdint>
#include <span>

#include "components/column.h"
#include "components/edge_order.h"

namespace pleat {

/// In slots (S): runs of kLanes edges that share no particle and are solved at once; edges that meet are in order.
/// Empty slots are edges of 1 m between `empty_place` and the place after it, behind the particles of Vec4Columns,
/// where the inverse mass is 0, so that lanes need no mask.
struct EdgeSlots {
  std::uint32_t count = 0, edge_count = 0, empty_place = 0;
  Column<std::uint32_t> particle[2];
  Column<float> rest_length;  // m

  explicit EdgeSlots(std::pmr::memory_resource* m)
      : particle{Column<std::uint32_t>(m), Column<std::uint32_t>(m)}, rest_length(m) {}
};

/// Gives edges, in the order in which they are to be solved and so long at rest, their slots. Throws std::bad_alloc.
void fill_slots(std::uint32_t particle_count, std::span<const EdgeEnds> edges, std::span<const float> lengths,
                EdgeSlots& slots);

}  // namespace pleat
