#include "engine/sleep.h"

#include "engine/schedule_row.h"
#include "systems/disturbance.h"

namespace pleat {
namespace {

constexpr float kFallAsleep = 0.5f;  // s
constexpr float kNear = 0.03f;       // m, in which a body that moves counts: what contact looks at, and some more

/// Whether a cloth of a lower layer that it may touch does not sleep.
bool is_carried([[maybe_unused]] const ClothTick& t) {
#ifdef PLEAT_WITH_COLLISION
  if (t.settings.layer < 2) return false;
  const World& w = t.world;
  const Box box = box_of(t.position, t.garment.particle_count).moved(t.cloth.origin);
  for (std::size_t k = 0; k < w.clothes.size(); ++k) {
    const bool near = may_touch(t.garment, t.settings.layer, t.settings.thickness, box, w.layers.clothes[k]);
    if (near && w.clothes[k].calm < kFallAsleep) return true;
  }
#endif
  return false;
}

Disturbance disturbance(const ClothTick& t) {
  return {.garment = &t.garment,
          .position = t.position,
          .origin = t.cloth.origin,
          .pin_previous = t.pin_previous,
          .pin_next = t.pin_next,
          .bodies = bodies_met(t),
          .reach = t.settings.thickness + kNear};
}

bool is_disturbed(const ClothTick& t) { return is_carried(t) || run(disturbance(t)); }

bool in_gusts(const ClothTick& t) {
  const bool in_air = t.settings.drag_coefficient > 0.0f || t.settings.lift_coefficient > 0.0f;
  return in_air && t.world.def.gust > 0.0f;
}

}  // namespace

void wake(ClothRecord& cloth) { cloth.calm = 0.0f; }

void wake_all(World& world) {
  for (ClothRecord& cloth : world.clothes) wake(cloth);
}

void wake_who_meets(World& world, std::uint32_t groups) {
  for (ClothRecord& cloth : world.clothes) {
    if ((cloth.settings.collides_with & groups) != 0) wake(cloth);
  }
}

void wake_around_bodies(World& world, Worker& worker) {
  if (!world.has_colliders()) return;
  for (ClothRecord& cloth : world.clothes) {
    if (cloth.calm == 0.0f) continue;
    Disturbance jumps = disturbance(ClothTick(world, worker, cloth));
    jumps.on_the_way = false;
    if (run(jumps)) wake(cloth);
  }
}

bool sleeps_on(const ClothTick& t) { return t.cloth.calm >= kFallAsleep && !is_disturbed(t); }

void stir(ClothTick& t) {
  if (t.settings.sleep_speed > 0.0f && is_disturbed(t)) wake(t.cloth);
}

void watch_rest(ClothTick& t) {
  const std::size_t n = t.garment.particle_count;
  const bool calm =
      !t.trouble && largest_speed(n, t.velocity) < t.settings.sleep_speed && !in_gusts(t) && !is_disturbed(t);
  t.cloth.calm = calm ? t.cloth.calm + t.frame_dt : 0.0f;
  if (t.cloth.calm >= kFallAsleep) clear(t.velocity, n);
}

}  // namespace pleat
