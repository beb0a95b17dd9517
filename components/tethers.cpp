#include "components/tethers.h"

#include <vector>

#include "components/geodesics.h"
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

void add_tethers(Garment& g) {
  const std::vector<Way> ways = ways_to_pins(g);
  for (Column<std::uint32_t>* column : {&g.tether_particle, &g.tether_pin}) column->resize(ways.size());
  g.tether_length.resize(ways.size());
  for (std::size_t t = 0; t < ways.size(); ++t) {
    g.tether_particle[t] = ways[t].particle, g.tether_pin[t] = ways[t].pin, g.tether_length[t] = ways[t].length;
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
