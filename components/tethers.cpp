#include "components/tethers.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "components/garment.h"
#include "components/geodesics.h"
#include "components/lanes.h"
#include "components/walk.h"

namespace pleat {
namespace {

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
  std::vector<EdgeEnds> edges;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) edges.push_back({g.edge_particle[0][e], g.edge_particle[1][e]});
  const auto walk = [&](std::span<const std::uint32_t> starts) { return Walk(starts, g.particle_count, edges); };
  if (g.pins.size() != 0) {
    g.depth = walk({g.pins.begin(), g.pins.end()}).depth();
    if (g.depth >= kSweepReach) add_tethers(g);
  } else {
    const std::uint32_t end = walk({edges[0].data(), 1}).order.back();
    g.depth = walk({&end, 1}).depth() / 2;
  }
}

}  // namespace pleat
