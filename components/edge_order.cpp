#include "components/edge_order.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <set>
#include <utility>

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

namespace {

/// Which edges meet which at a particle, one after the other.
struct Chains {
  /// For each edge: those that come next at its ends, or kEmptySlot; how many come before it there, 0 to 2; and how
  /// many the longest chain has that begins with it.
  std::vector<EdgeEnds> next;
  std::vector<std::uint32_t> before, length;

  Chains(std::uint32_t particle_count, std::span<const EdgeEnds> edges)
      : next(edges.size()), before(edges.size()), length(edges.size()) {
    std::vector<std::uint32_t> first(particle_count, kEmptySlot);  // at each particle, of the edges seen so far
    for (auto e = static_cast<std::uint32_t>(edges.size()); e-- > 0;) {
      assert(edges[e][0] != edges[e][1]);
      for (std::size_t k = 0; k < 2; ++k) {
        std::uint32_t& at = first[edges[e][k]];
        if (at != kEmptySlot) length[e] = std::max(length[e], length[at]), ++before[at];
        next[e][k] = std::exchange(at, e);
      }
      ++length[e];
    }
  }
};

}  // namespace

std::vector<std::uint32_t> slots_of(std::uint32_t particle_count, std::span<const EdgeEnds> edges,
                                    std::uint32_t lanes) {
  const auto count = static_cast<std::uint32_t>(edges.size());
  Chains chains(particle_count, edges);
  std::set<std::uint32_t> ready;                             // those that may come next
  std::set<std::pair<std::uint32_t, std::uint32_t>> urgent;  // the same by chain, the shortest first
  const auto add = [&](std::uint32_t e) { ready.insert(e), urgent.insert({chains.length[e], e}); };
  for (std::uint32_t e = 0; e < count; ++e) {
    if (chains.before[e] == 0) add(e);
  }
  std::vector<std::uint32_t> slots, stage;
  // That are left: as many as the longest chain has.
  std::uint32_t stages = urgent.empty() ? 0 : urgent.rbegin()->first;
  for (std::uint32_t left = count; left != 0; left -= static_cast<std::uint32_t>(stage.size()), --stages) {
    stage.clear();
    const auto take = [&](std::uint32_t e) { stage.push_back(e), ready.erase(e), urgent.erase({chains.length[e], e}); };
    while (!urgent.empty() && urgent.rbegin()->first == stages) take(urgent.rbegin()->second);
    const std::size_t mean = (left + stages - 1) / stages, wanted = std::max(stage.size(), mean);
    const std::size_t whole = (wanted + lanes - 1) / lanes * lanes;
    while (stage.size() < whole && !ready.empty()) take(*ready.begin());
    std::sort(stage.begin(), stage.end());
    for (const std::uint32_t e : stage) {
      for (const std::uint32_t next : chains.next[e]) {
        if (next != kEmptySlot && --chains.before[next] == 0) add(next);
      }
    }
    slots.insert(slots.end(), stage.begin(), stage.end());
    slots.resize((slots.size() + lanes - 1) / lanes * lanes, kEmptySlot);
  }
  return slots;
}

}  // namespace pleat
