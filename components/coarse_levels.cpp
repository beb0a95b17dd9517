#include "components/coarse_levels.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <vector>

#include "components/garment.h"
#include "components/walk.h"

namespace pleat {
namespace {

constexpr float kShortest = 1e-9f;  // m, that a way counts as

struct Link {
  std::uint32_t to;
  float length;  // m
};

/// The particles of a level, and which of them are joined.
struct Net {
  std::vector<std::uint32_t> particles;
  std::vector<EdgeEnds> edges;
  std::vector<std::vector<Link>> links;  // of every particle of the garment

  explicit Net(std::uint32_t count) : links(count) {}
  void join(std::uint32_t i, std::uint32_t j, float length) {
    edges.push_back({i, j});
    links[i].push_back({j, length}), links[j].push_back({i, length});
  }
};

Net finest(const Garment& g) {
  Net net(g.particle_count);
  for (std::uint32_t i = 0; i < g.particle_count; ++i) net.particles.push_back(i);
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    net.join(g.edge_particle[0][e], g.edge_particle[1][e], g.edge_rest_length[e]);
  }
  return net;
}

/// Which particles make the next level: all that are no neighbours of one before, where the walk comes and then
/// elsewhere.
std::vector<bool> choose_apart(const Net& net, const Walk& walk) {
  std::vector<bool> chosen(net.links.size()), beside(net.links.size());
  for (const auto* particles : {&walk.order, &net.particles}) {
    for (const std::uint32_t i : *particles) {
      if (beside[i]) continue;
      chosen[i] = true;
      for (const Link& link : net.links[i]) beside[link.to] = true;
    }
  }
  return chosen;
}

/// The chosen neighbours of a particle that is not, nearest first.
std::vector<Link> parents_of(const Net& net, const std::vector<bool>& chosen, std::uint32_t i) {
  std::vector<Link> parents;
  std::ranges::copy_if(net.links[i], std::back_inserter(parents), [&](const Link& link) { return chosen[link.to]; });
  std::ranges::sort(parents, {}, [](const Link& link) { return std::tuple(link.length, link.to); });
  return parents;
}

/// Joins chosen particles whose neighbourhoods meet.
Net coarser(const Net& net, const std::vector<bool>& chosen) {
  Net out(static_cast<std::uint32_t>(net.links.size()));
  std::vector<Link> nearest(net.links.size());
  for (const std::uint32_t i : net.particles) {
    if (chosen[i]) out.particles.push_back(i);
    nearest[i] = chosen[i] ? Link{i, 0.0f} : parents_of(net, chosen, i).front();
  }
  std::map<EdgeEnds, float> shortest;
  for (const std::uint32_t i : net.particles) {
    for (const Link& link : net.links[i]) {
      const auto [a, to_a] = nearest[i];
      const auto [b, to_b] = nearest[link.to];
      if (a >= b) continue;  // the same, or met from the other side
      const float way = to_a + link.length + to_b;
      const auto [at, is_new] = shortest.try_emplace({a, b}, way);
      at->second = std::min(at->second, way);
    }
  }
  for (const auto& [ends, length] : shortest) out.join(ends[0], ends[1], length);
  return out;
}

void add_children(const Garment& g, const Net& net, const std::vector<bool>& chosen, CoarseLevel& level) {
  std::vector<std::uint32_t> children;
  std::ranges::copy_if(net.particles, std::back_inserter(children),
                       [&](std::uint32_t i) { return !chosen[i] && g.pinned[i] == 0; });
  const std::size_t count = padded(children.size());
  level.child.resize(count);
  std::fill(level.child.begin(), level.child.end(), g.slots.empty_place);
  for (std::size_t k = 0; k < kParents; ++k) {
    level.parent[k].resize(count), level.weight[k].resize(count);
    std::fill(level.parent[k].begin(), level.parent[k].end(), g.slots.empty_place);
  }
  for (std::size_t c = 0; c < children.size(); ++c) {
    std::vector<Link> parents = parents_of(net, chosen, children[c]);
    parents.resize(std::min(parents.size(), kParents));
    float sum = 0.0f;
    for (const Link& parent : parents) sum += 1.0f / std::max(parent.length, kShortest);
    level.child[c] = children[c];
    for (std::size_t k = 0; k < parents.size(); ++k) {
      level.parent[k][c] = parents[k].to;
      level.weight[k][c] = 1.0f / (std::max(parents[k].length, kShortest) * sum);
    }
  }
}

void add_edges(const Garment& g, const Net& net, std::span<const std::uint32_t> from, CoarseLevel& level) {
  std::map<EdgeEnds, float> length_of;
  std::vector<EdgeEnds> edges;
  for (const std::uint32_t i : net.particles) {
    for (const Link& link : net.links[i]) {
      if (i > link.to || (g.pinned[i] != 0 && g.pinned[link.to] != 0)) continue;
      edges.push_back({i, link.to}), length_of[edges.back()] = link.length;
    }
  }
  order_edges(g.particle_count, from, edges);
  std::vector<float> lengths;
  for (const EdgeEnds& edge : edges) lengths.push_back(length_of[edge]);
  fill_slots(g.particle_count, edges, lengths, level.slots);
}

}  // namespace

void add_coarse_levels(Garment& g) {
  std::vector<std::uint32_t> roots(g.pins.begin(), g.pins.end());
  Net net = finest(g);
  for (;;) {
    const Walk walk(roots, g.particle_count, net.edges);
    if (walk.depth() < kCoarseDepth) break;
    const std::vector<bool> chosen = choose_apart(net, walk);
    CoarseLevel level(g.coarse.get_allocator().resource());
    add_children(g, net, chosen, level);
    net = coarser(net, chosen);
    std::erase_if(roots, [&](std::uint32_t i) { return !chosen[i]; });
    add_edges(g, net, roots, level);
    g.coarse.insert(g.coarse.begin(), std::move(level));
  }
  g.way_count = g.slots.count;
  for (CoarseLevel& level : g.coarse) level.way_begin = g.way_count, g.way_count += level.slots.count;
}

}  // namespace pleat
