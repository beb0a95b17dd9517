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

/// Of each particle those of the next level beside it, nearest first; one of that level has but itself.
using Parents = std::vector<std::vector<Link>>;

/// The next level are all that are no neighbours of one before, where the walk comes and then elsewhere.
Parents choose_parents(const Net& net, const Walk& walk) {
  Parents parents(net.links.size());
  for (const auto* particles : {&walk.order, &net.particles}) {
    for (const std::uint32_t i : *particles) {
      if (!parents[i].empty()) continue;
      parents[i] = {{i, 0.0f}};
      for (const Link& link : net.links[i]) parents[link.to].push_back({i, link.length});
    }
  }
  for (auto& of_one : parents) {
    std::ranges::sort(of_one, {}, [](const Link& link) { return std::tuple(link.length, link.to); });
  }
  return parents;
}

bool is_chosen(const Parents& parents, std::uint32_t i) { return parents[i].front().to == i; }

/// Joins chosen particles whose neighbourhoods meet.
Net coarser(const Net& net, const Parents& parents) {
  Net out(static_cast<std::uint32_t>(net.links.size()));
  std::ranges::copy_if(net.particles, std::back_inserter(out.particles),
                       [&](std::uint32_t i) { return is_chosen(parents, i); });
  std::map<EdgeEnds, float> shortest;
  for (const std::uint32_t i : net.particles) {
    for (const Link& link : net.links[i]) {
      const auto [a, to_a] = parents[i].front();
      const auto [b, to_b] = parents[link.to].front();
      if (a >= b) continue;  // the same, or met from the other side
      const float way = to_a + link.length + to_b;
      const auto [at, is_new] = shortest.try_emplace({a, b}, way);
      at->second = std::min(at->second, way);
    }
  }
  for (const auto& [ends, length] : shortest) out.join(ends[0], ends[1], length);
  return out;
}

void add_children(const Garment& g, const Net& net, const Parents& parents, CoarseLevel& level) {
  std::vector<std::uint32_t> children;
  std::ranges::copy_if(net.particles, std::back_inserter(children),
                       [&](std::uint32_t i) { return !is_chosen(parents, i) && g.pinned[i] == 0; });
  const std::size_t count = padded(children.size());
  level.child.resize(count);
  std::fill(level.child.begin(), level.child.end(), g.slots.empty_place);
  for (std::size_t k = 0; k < kParents; ++k) {
    level.parent[k].resize(count), level.weight[k].resize(count);
    std::fill(level.parent[k].begin(), level.parent[k].end(), g.slots.empty_place);
  }
  for (std::size_t c = 0; c < children.size(); ++c) {
    const std::vector<Link>& all = parents[children[c]];
    const std::span nearest(all.begin(), std::min(all.size(), kParents));
    float sum = 0.0f;
    for (const Link& parent : nearest) sum += 1.0f / std::max(parent.length, kShortest);
    level.child[c] = children[c];
    for (std::size_t k = 0; k < nearest.size(); ++k) {
      level.parent[k][c] = nearest[k].to;
      level.weight[k][c] = 1.0f / (std::max(nearest[k].length, kShortest) * sum);
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
    const Parents parents = choose_parents(net, walk);
    CoarseLevel level(g.coarse.get_allocator().resource());
    add_children(g, net, parents, level);
    net = coarser(net, parents);
    std::erase_if(roots, [&](std::uint32_t i) { return !is_chosen(parents, i); });
    add_edges(g, net, roots, level);
    g.coarse.insert(g.coarse.begin(), std::move(level));
  }
  g.way_count = g.slots.count;
  for (CoarseLevel& level : g.coarse) level.way_begin = g.way_count, g.way_count += level.slots.count;
}

}  // namespace pleat
