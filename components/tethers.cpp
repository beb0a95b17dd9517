#include "components/tethers.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <span>
#include <tuple>
#include <vector>

#include "components/garment.h"

namespace pleat {
namespace {

constexpr std::size_t kTethersPerParticle = 2;  // to its nearest pins

/// The edges that meet at each particle.
struct Neighbours {
  struct Side {
    std::uint32_t particle;
    float length;
  };
  std::vector<std::uint32_t> begin;
  std::vector<Side> sides;

  explicit Neighbours(const Garment& g)
      : begin(std::size_t{g.particle_count} + 1), sides(std::size_t{2} * g.edge_count) {
    for (const auto& end : g.edge_particle) {
      for (const std::uint32_t i : end) ++begin[i + 1];
    }
    for (std::uint32_t i = 0; i < g.particle_count; ++i) begin[i + 1] += begin[i];
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t e = 0; e < g.edge_count; ++e) {
      const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
      sides[next[i]++] = {j, g.edge_rest_length[e]};
      sides[next[j]++] = {i, g.edge_rest_length[e]};
    }
  }
  std::span<const Side> of(std::uint32_t i) const { return {sides.data() + begin[i], sides.data() + begin[i + 1]}; }
};

struct Farthest {
  std::uint32_t particle, edges;
};

/// Breadth first from `start`: what is reached last, and over how many edges.
Farthest farthest_from(std::vector<std::uint32_t> start, const Neighbours& around, std::uint32_t particle_count) {
  std::vector<std::uint32_t> depth(particle_count, kNone);
  for (const std::uint32_t i : start) depth[i] = 0;
  std::vector<std::uint32_t>& queue = start;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const auto& [j, length] : around.of(queue[head])) {
      if (depth[j] != kNone) continue;
      depth[j] = depth[queue[head]] + 1;
      queue.push_back(j);
    }
  }
  return {queue.back(), depth[queue.back()]};
}

/// Dijkstra from all pins at once; a particle is done when its nearest pins have reached it.
void add_tethers(const Neighbours& around, Garment& g) {
  using Arrival = std::tuple<float, std::uint32_t, std::uint32_t>;  // length of the way, particle, pin
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> arrivals;
  std::vector<std::array<std::uint32_t, kTethersPerParticle>> pins_of(g.particle_count, {kNone, kNone});
  std::vector<Arrival> tethers;
  for (const std::uint32_t pin : g.pins) arrivals.emplace(0.0f, pin, pin);
  while (!arrivals.empty()) {
    const auto [way, i, pin] = arrivals.top();
    arrivals.pop();
    if (g.pinned[i] && i != pin) continue;
    auto& known = pins_of[i];
    const auto place = std::ranges::find_if(known, [pin](std::uint32_t k) { return k == kNone || k == pin; });
    if (place == known.end() || *place == pin) continue;
    *place = pin;
    if (i != pin) tethers.emplace_back(way, i, pin);
    for (const auto& [j, length] : around.of(i)) arrivals.emplace(way + length, j, pin);
  }
  for (Column<std::uint32_t>* column : {&g.tether_particle, &g.tether_pin}) column->resize(tethers.size());
  g.tether_length.resize(tethers.size());
  for (std::size_t t = 0; t < tethers.size(); ++t) {
    std::tie(g.tether_length[t], g.tether_particle[t], g.tether_pin[t]) = tethers[t];
  }
}

}  // namespace

void measure_tethers(Garment& g) {
  const Neighbours around(g);
  if (g.pins.size() != 0) {
    g.depth = farthest_from({g.pins.begin(), g.pins.end()}, around, g.particle_count).edges;
    if (g.depth >= kSweepReach) add_tethers(around, g);
  } else {
    const Farthest end = farthest_from({g.edge_particle[0][0]}, around, g.particle_count);
    g.depth = farthest_from({end.particle}, around, g.particle_count).edges / 2;
  }
}

}  // namespace pleat
