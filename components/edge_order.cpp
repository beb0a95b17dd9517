#include "components/edge_order.h"

#include <algorithm>
#include <bit>

namespace pleat {
namespace {

constexpr std::uint32_t kFar = 0xffffffffu;

/// Of each particle, edges to the nearest of `from`; 0 where there is none in its part.
std::vector<std::uint32_t> count_hops(std::uint32_t particle_count, std::span<const std::uint32_t> from,
                                      std::span<const EdgeEnds> edges) {
  std::vector<std::uint32_t> begin(std::size_t{particle_count} + 1), across(2 * edges.size());
  for (const EdgeEnds& edge : edges) ++begin[edge[0] + 1], ++begin[edge[1] + 1];
  for (std::uint32_t i = 0; i < particle_count; ++i) begin[i + 1] += begin[i];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const auto& [i, j] : edges) across[next[i]++] = j, across[next[j]++] = i;

  std::vector<std::uint32_t> hops(particle_count, kFar), queue(from.begin(), from.end());
  for (const std::uint32_t i : from) hops[i] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::uint32_t i = queue[head];
    for (std::uint32_t k = begin[i]; k < begin[i + 1]; ++k) {
      const std::uint32_t j = across[k];
      if (hops[j] == kFar) hops[j] = hops[i] + 1, queue.push_back(j);
    }
  }
  std::replace(hops.begin(), hops.end(), kFar, 0u);
  return hops;
}

}  // namespace

void order_edges(std::uint32_t particle_count, std::span<const std::uint32_t> from, std::vector<EdgeEnds>& edges) {
  struct Place {
    std::uint32_t band;
    int colour;
    EdgeEnds edge;
    auto operator<=>(const Place&) const = default;
  };
  const std::vector<std::uint32_t> hops = count_hops(particle_count, from, edges);
  std::vector<Place> places;
  for (const EdgeEnds& edge : edges) places.push_back({hops[edge[0]] + hops[edge[1]], 0, edge});
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

std::vector<std::uint32_t> runs_of(std::uint32_t particle_count, std::span<const EdgeEnds> edges,
                                   std::uint32_t longest) {
  std::vector<std::uint32_t> begins;
  std::vector<std::size_t> met_in(particle_count);  // the last run that the particle is in, counted from 1
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto [i, j] = edges[e];
    const bool shares = met_in[i] == begins.size() || met_in[j] == begins.size();
    if (begins.empty() || shares || e - begins.back() == longest) begins.push_back(e);
    met_in[i] = met_in[j] = begins.size();
  }
  begins.push_back(static_cast<std::uint32_t>(edges.size()));
  return begins;
}

}  // namespace pleat
