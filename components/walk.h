// The particles of a mesh breadth first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "components/edge_order.h"

namespace pleat {

struct Walk {
  static constexpr std::uint32_t kNever = 0xffffffffu;

  std::vector<std::uint32_t> order;  // those it starts from, then all that edges join to them, nearest first
  std::vector<std::uint32_t> hops;   // of each particle, edges to the nearest start; kNever where none is joined to it

  /// Neighbours are come to in the order of their edges. Cost: O(P + E). Throws std::bad_alloc.
  Walk(std::span<const std::uint32_t> starts, std::size_t particle_count, std::span<const EdgeEnds> edges);
  /// The hops of the last particle, which are the most.
  std::uint32_t depth() const { return order.empty() ? 0 : hops[order.back()]; }
};

}  // namespace pleat
