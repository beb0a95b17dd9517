#include "components/walk.h"

namespace pleat {

Walk::Walk(std::span<const std::uint32_t> starts, std::size_t particle_count, std::span<const EdgeEnds> edges)
    : order(starts.begin(), starts.end()), hops(particle_count, kNever) {
  std::vector<std::vector<std::uint32_t>> beside(particle_count);
  for (const auto& [i, j] : edges) beside[i].push_back(j), beside[j].push_back(i);
  for (const std::uint32_t i : starts) hops[i] = 0;
  for (std::size_t head = 0; head < order.size(); ++head) {
    for (const std::uint32_t j : beside[order[head]]) {
      if (hops[j] == kNever) hops[j] = hops[order[head]] + 1, order.push_back(j);
    }
  }
}

}  // namespace pleat
