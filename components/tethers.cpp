#include "components/tethers.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "components/geodesics.h"
#include "components/lanes.h"
#include "components/neighbours.h"

namespace pleat {
namespace {

struct Farthest {
  std::uint32_t particle, edges;
};

/// Breadth first from `start`: what is reached last, and over how many edges.
Farthest farthest_from(std::vector<std::uint32_t> start, const IndexLists& edges_at, const Garment& g) {
  std::vector<std::uint32_t> depth(g.particle_count, kNone);
  for (const std::uint32_t i : start) depth[i] = 0;
  std::vector<std::uint32_t>& queue = start;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const std::uint32_t e : edges_at.of(queue[head])) {
      const std::uint32_t j = across(g, e, queue[head]);
      if (depth[j] != kNone) continue;
      depth[j] = depth[queue[head]] + 1;
      queue.push_back(j);
    }
  }
  return {queue.back(), depth[queue.back()]};
}

/// Every particle's nearest pin, then every one's next: a run of lanes has no particle twice.
void add_tethers(Garment& g) {
  std::vector<Way> ways = ways_to_pins(g);
  std::ranges::sort(ways, {}, [](const Way& way) { return std::tuple(way.particle, way.length, way.pin); });
  const std::uint32_t nowhere = g.slots.empty_place;
  for (std::size_t nth = 0; nth < kPinsPerParticle; ++nth) {
    std::size_t before = 0;  // ways of the same particle
    for (std::size_t k = 0; k < ways.size(); ++k) {
      before = k > 0 && ways[k - 1].particle == ways[k].particle ? before + 1 : 0;
      if (before != nth) continue;
      g.tether_particle.push_back(ways[k].particle);
      g.tether_pin.push_back(ways[k].pin);
      g.tether_length.push_back(ways[k].length);
    }
    while (g.tether_length.size() % kLanes != 0) {
      g.tether_particle.push_back(nowhere), g.tether_pin.push_back(nowhere), g.tether_length.push_back(1.0f);
    }
  }
}

}  // namespace

void measure_tethers(Garment& g) {
  const IndexLists edges_at(g.particle_count, g.edge_particle);
  if (g.pins.size() != 0) {
    g.depth = farthest_from({g.pins.begin(), g.pins.end()}, edges_at, g).edges;
    if (g.depth >= kSweepReach) add_tethers(g);
  } else {
    const Farthest end = farthest_from({g.edge_particle[0][0]}, edges_at, g);
    g.depth = farthest_from({end.particle}, edges_at, g).edges / 2;
  }
}

}  // namespace pleat
