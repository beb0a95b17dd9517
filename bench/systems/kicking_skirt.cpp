#include "bench/systems/kicking_skirt.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/calls.h"

namespace pleat::bench {
namespace {

void must(pleat_result result, const char* what) {
  if (result != PLEAT_OK) throw std::runtime_error(std::string("the skirt: ") + what + " was refused");
}

pleat_collider add_capsule(pleat_world* world, const float (&a)[3], const float (&b)[3], float radius) {
  pleat_collider_def def;
  must(call::collider_def_init(&def, sizeof def), "a body's defaults");
  std::copy_n(a, 3, def.a);
  std::copy_n(b, 3, def.b);
  def.radius = radius;
  pleat_collider collider{};
  must(call::collider_create(world, &def, &collider), "a body");
  return collider;
}

}  // namespace

KickingSkirt::KickingSkirt(SkirtSize size, pleat_stage_fn stage, void* stage_user) {
  pleat_world_def def;
  must(call::world_def_init(&def, sizeof def), "the world's defaults");
  def.allocate = Arena::allocate;
  def.free = Arena::release;
  def.memory_user = &arena_;
  def.stage = stage;
  def.stage_user = stage_user;
  must(call::world_create(&def, &world_), "the world");
  make_cloth(size);
  add_capsule(world_, {-0.07f, 0.95f, 0.0f}, {0.07f, 0.95f, 0.0f}, 0.11f);
  add_capsule(world_, {-0.09f, 0.9f, 0.0f}, {-0.09f, 0.5f, 0.0f}, 0.07f);
  add_capsule(world_, {-0.09f, 0.5f, 0.0f}, {-0.09f, 0.1f, 0.0f}, 0.05f);
  thigh_ = add_capsule(world_, {0.09f, 0.9f, 0.0f}, {0.09f, 0.5f, 0.0f}, 0.07f);
  calf_ = add_capsule(world_, {0.09f, 0.5f, 0.0f}, {0.09f, 0.1f, 0.0f}, 0.05f);
}

KickingSkirt::~KickingSkirt() { call::world_destroy(world_); }

void KickingSkirt::make_cloth(SkirtSize size) {
  const std::vector<uint32_t> ring_sizes(size.rings, size.columns);
  std::vector<float> radii, heights;
  for (uint32_t r = 0; r < size.rings; ++r) {
    const float down = static_cast<float>(r) / static_cast<float>(size.rings - 1);
    radii.push_back(std::lerp(0.14f, 0.35f, down));
    heights.push_back(std::lerp(1.05f, 0.55f, down));
  }
  pleat_shape_def shape;
  must(call::shape_def_init(&shape, sizeof shape), "a shape's defaults");
  shape.kind = PLEAT_SHAPE_RINGS;
  shape.ring_count = size.rings;
  shape.ring_sizes = ring_sizes.data(), shape.ring_radii = radii.data(), shape.ring_heights = heights.data();
  uint32_t vertices = 0, triangles = 0;
  must(call::shape_size(&shape, &vertices, &triangles), "the shape");
  std::vector<float> positions(3 * vertices);
  std::vector<uint32_t> indices(3 * triangles), pins;
  must(call::shape_build(&shape, positions.data(), indices.data()), "the shape");
  for (uint32_t i = 0; i < size.columns; ++i) pins.push_back(i);

  pleat_garment_def garment;
  must(call::garment_def_init(&garment, sizeof garment), "a garment's defaults");
  garment.positions = positions.data(), garment.vertex_count = vertices;
  garment.triangles = indices.data(), garment.triangle_count = triangles;
  garment.pins = pins.data(), garment.pin_count = size.columns;
  pleat_cloth_def cloth;
  must(call::cloth_def_init(&cloth, sizeof cloth), "a cloth's defaults");
  must(call::garment_create(world_, &garment, nullptr, &cloth.garment), "the garment");
  pleat_cloth made{};
  must(call::cloth_create(world_, &cloth, &made), "the cloth");
}

void KickingSkirt::move_leg(float angle) {
  const float forward = 0.4f * std::sin(angle), down = 0.4f * std::cos(angle);
  const float hip[3] = {0.09f, 0.9f, 0.0f}, knee[3] = {0.09f, 0.9f - down, forward},
              foot[3] = {0.09f, 0.9f - 2.0f * down, 2.0f * forward};
  must(call::collider_move_capsule(world_, thigh_, hip, knee), "the thigh's motion");
  must(call::collider_move_capsule(world_, calf_, knee, foot), "the calf's motion");
}

void KickingSkirt::tick() {
  time_ += kTick;
  move_leg(1.2f * std::max(0.0f, std::sin(2.0f * std::numbers::pi_v<float> * time_)));
  must(call::world_step(world_, kTick), "a tick");
}

}  // namespace pleat::bench
