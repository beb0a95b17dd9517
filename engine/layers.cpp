#include "engine/layers.h"

#include <algorithm>

#ifdef PLEAT_WITH_COLLISION
#include "systems/box.h"
#include "systems/near_search.h"
#endif

namespace pleat {

std::uint32_t top_layer(const World& world) {
  std::uint32_t top = 0;
  for (const ClothRecord& cloth : world.clothes) top = std::max(top, cloth.settings.layer);
  return top;
}

void forget_layer_pairs(World& world) {
  for (ClothRecord& cloth : world.clothes) cloth.layer_pair_count = kNone;
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
  const Box box = box_of(seen.begin, count).with(box_of(seen.end, count));
  seen.low = box.low, seen.high = box.high;
}
#else
void make_layer_room(World&, const ClothRecord&) {}
void begin_layers(World&) {}
void publish_layer(World&, std::uint32_t) {}
#endif

}  // namespace pleat
