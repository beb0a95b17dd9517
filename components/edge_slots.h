// Edges in the places in which they are solved.
#pragma once

#include <cstdint>
#include <span>

#include "components/column.h"
#include "components/edge_order.h"
#include "components/vec4.h"

namespace pleat {

/// In slots (S): runs of kLanes edges that share no particle and are solved at once; edges that meet are in order.
/// Empty slots are edges of 1 m between `empty_place` and the place after it, behind the particles of Vec4Columns,
/// where the inverse mass is 0, so that lanes need no mask.
struct EdgeSlots {
  std::uint32_t count = 0, edge_count = 0, empty_place = 0;
  Column<Vec4Place> place[2];  // of their ends in Vec4Columns
  Column<float> rest_length;   // m

  explicit EdgeSlots(std::pmr::memory_resource* m)
      : place{Column<Vec4Place>(m), Column<Vec4Place>(m)}, rest_length(m) {}
  std::uint32_t particle(std::size_t end, std::uint32_t slot) const { return place[end][slot].index(); }
};

/// Gives edges, in the order in which they are to be solved and so long at rest, their slots. Throws std::bad_alloc.
void fill_slots(std::uint32_t particle_count, std::span<const EdgeEnds> edges, std::span<const float> lengths,
                EdgeSlots& slots);

}  // namespace pleat
