#include "engine/layers.h"

#include <algorithm>
#include <span>

#include "engine/sleep.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/box.h"
#include "systems/near_search.h"
#endif

namespace pleat {
namespace {

/// Those that the cloth has found.
std::span<NearPair> layer_pairs(World& world, const ClothRecord& cloth) {
  if (cloth.layer_pair_count == kNone) return {};
  const std::size_t first = std::size_t{SelfColumns::kPairsPerParticle} * cloth.particle_begin;
  return {world.layers.pairs.data() + first, cloth.layer_pair_count};
}

}  // namespace

std::uint32_t top_layer(const World& world) {
  std::uint32_t top = 0;
  for (const ClothRecord& cloth : world.clothes) top = std::max(top, cloth.settings.layer);
  return top;
}

void forget_layer_pairs(World& world, ClothRecord& cloth) {
  cloth.layer_pair_count = kNone;
  const auto position = static_cast<std::uint32_t>(&cloth - world.clothes.data());
  const auto before = [](const NearPair& pair, std::uint32_t other) { return pair.cloth < other; };
  for (ClothRecord& other : world.clothes) {
    other.layers_sought.near.remove(position);  // if it still is near, the other sees that it is missing
    const std::span<NearPair> pairs = layer_pairs(world, other);
    const auto begin = std::lower_bound(pairs.begin(), pairs.end(), position, before);
    const auto end = std::lower_bound(begin, pairs.end(), position + 1, before);
    if (begin == end) continue;
    std::move(end, pairs.end(), begin);
    other.layer_pair_count -= static_cast<std::uint32_t>(end - begin);
    wake(other);
  }
}

void renumber_layer_pairs(World& world, std::uint32_t position) {
  for (ClothRecord& cloth : world.clothes) {
    for (std::uint32_t& near : cloth.layers_sought.near.kept()) near -= near > position ? 1 : 0;
    for (NearPair& pair : layer_pairs(world, cloth)) pair.cloth -= pair.cloth > position ? 1 : 0;
  }
}

#ifdef PLEAT_WITH_COLLISION
void make_layer_room(World& world, const ClothRecord& cloth) {
  LayerColumns& layers = world.layers;
  if (cloth.settings.layer == 0 && layers.begin.size() == 0) return;
  const std::size_t particles = world.particles.mass.size();
  at_least(layers.begin, particles);
  at_least(layers.sought_at, particles);
  at_least(layers.pairs, SelfColumns::kPairsPerParticle * particles);
  at_least(layers.clothes, world.clothes.size());
}

void begin_layers(World& world) {
  LayerColumns& layers = world.layers;
  if (layers.begin.size() == 0) return;
  copy(layers.begin.view(), world.particles.position.view(),
       std::min(layers.begin.size(), world.particles.position.size()));
  std::fill(layers.clothes.begin(), layers.clothes.end(), LayerCloth{});
}

void publish_layer(World& world, std::uint32_t position) {
  const ClothRecord& cloth = world.clothes[position];
  if (cloth.settings.layer == 0) return;
  LayerCloth& seen = world.layers.clothes[position];
  const std::uint32_t count = cloth.garment().particle_count;
  seen.garment = &cloth.garment();
  seen.layer = cloth.settings.layer;
  seen.begin = std::as_const(world.layers.begin).view().from(cloth.particle_begin);
  seen.end = std::as_const(world.particles.position).view().from(cloth.particle_begin);
  seen.origin = cloth.origin;
  const Box box = box_of(seen.begin, count).with(box_of(seen.end, count)).moved(cloth.origin);
  seen.low = box.low, seen.high = box.high;
}
#else
void make_layer_room(World&, const ClothRecord&) {}
void begin_layers(World&) {}
void publish_layer(World&, std::uint32_t) {}
#endif

}  // namespace pleat
