#include "components/edge_order.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <queue>
#include <set>

#include "components/walk.h"

namespace pleat {
namespace {

/// Edges across, between particles as far as each other, come with those that lead on from the next ones out, which
/// they do not meet: a processor works on runs of both at once.
constexpr std::uint32_t kLate = 3;

}  // namespace

void order_edges(std::uint32_t particle_count, std::span<const std::uint32_t> from, std::vector<EdgeEnds>& edges) {
  struct Place {
    std::uint32_t band;
    int colour;
    EdgeEnds edge;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<std::uint32_t> hops = Walk(from, particle_count, edges).hops;
  std::replace(hops.begin(), hops.end(), Walk::kNever, 0u);
  std::vector<Place> places;
  for (const EdgeEnds& edge : edges) {
    const std::uint32_t from_pins = hops[edge[0]] + hops[edge[1]], late = hops[edge[0]] == hops[edge[1]] ? kLate : 0;
    places.push_back({from_pins + late, 0, edge});
  }
  std::sort(places.begin(), places.end());

  // The first colour that neither end has yet, of 64: an edge between more of them may take one twice.
  std::vector<std::uint64_t> taken(particle_count);
  std::uint32_t band = 0;
  for (Place& place : places) {
    if (place.band != band) std::fill(taken.begin(), taken.end(), 0), band = place.band;
    const auto [i, j] = place.edge;
    place.colour = std::min(std::countr_one(taken[i] | taken[j]), 63);
    taken[i] |= std::uint64_t{1} << place.colour, taken[j] |= std::uint64_t{1} << place.colour;
  }
  std::sort(places.begin(), places.end());
  std::transform(places.begin(), places.end(), edges.begin(), [](const Place& place) { return place.edge; });
}

std::vector<std::uint32_t> slots_of(std::uint32_t particle_count, std::span<const EdgeEnds> edges,
                                    std::uint32_t lanes) {
  std::vector<std::vector<std::uint32_t>> waiting(particle_count);  // at each particle, the next one last
  for (std::uint32_t e = static_cast<std::uint32_t>(edges.size()); e-- > 0;) {
    for (const std::uint32_t i : edges[e]) waiting[i].push_back(e);
  }
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> ready;
  const auto is_next = [&](std::uint32_t e) {
    return waiting[edges[e][0]].back() == e && waiting[edges[e][1]].back() == e;
  };
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (is_next(e)) ready.push(e);
  }
  std::vector<std::uint32_t> slots;
  while (!ready.empty()) {
    const std::size_t begin = slots.size();
    for (; slots.size() < begin + lanes && !ready.empty(); ready.pop()) slots.push_back(ready.top());
    for (std::size_t s = begin, end = slots.size(); s < end; ++s) {
      for (const std::uint32_t i : edges[slots[s]]) waiting[i].pop_back();
    }
    std::set<std::uint32_t> next;  // an edge may be found at both its ends
    for (std::size_t s = begin, end = slots.size(); s < end; ++s) {
      for (const std::uint32_t i : edges[slots[s]]) {
        if (!waiting[i].empty() && is_next(waiting[i].back())) next.insert(waiting[i].back());
      }
    }
    for (const std::uint32_t e : next) ready.push(e);
    slots.resize(begin + lanes, kEmptySlot);
  }
  return slots;
}

}  // namespace pleat
