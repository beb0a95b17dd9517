#include "components/edge_slots.h"

#include "components/lanes.h"

namespace pleat {

void fill_slots(std::uint32_t particle_count, std::span<const EdgeEnds> edges, std::span<const float> lengths,
                EdgeSlots& slots) {
  const std::vector<std::uint32_t> order = slots_of(particle_count, edges, kLanes);
  slots.count = static_cast<std::uint32_t>(order.size());
  slots.edge_count = static_cast<std::uint32_t>(edges.size());
  for (auto& column : slots.place) column.resize(slots.count);
  slots.rest_length.resize(slots.count);
  slots.empty_place = static_cast<std::uint32_t>(padded(particle_count));
  for (std::size_t s = 0; s < order.size(); ++s) {
    const bool empty = order[s] == kEmptySlot;
    for (std::uint32_t k : {0u, 1u}) {
      slots.place[k][s] = Vec4Place::of(empty ? slots.empty_place + k : edges[order[s]][k]);
    }
    slots.rest_length[s] = empty ? 1.0f : lengths[order[s]];
  }
}

}  // namespace pleat
