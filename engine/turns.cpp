#include "engine/turns.h"

#include <algorithm>

#include "engine/budget.h"
#include "engine/run.h"
#include "systems/rigid_carry.h"
#include "systems/rigid_fit.h"
#ifdef PLEAT_WITH_SMOOTHING
#include "systems/surface_carry.h"
#endif
#ifdef PLEAT_WITH_COLLISION
#include "systems/substep_bound.h"
#endif

namespace pleat {

namespace {

constexpr float kReachATick = 0.0625f;  // of bodies between turns, for each tick of as many as the cloth takes one of

}  // namespace

float travel_of_bodies([[maybe_unused]] const ClothTick& t, [[maybe_unused]] float reach,
                       [[maybe_unused]] const std::optional<RigidMotion>& carry) {
#ifdef PLEAT_WITH_COLLISION
  if (t.world.capsules.size() == 0 && t.world.meshes.empty()) return 0.0f;
  return run(SubstepBound{.particle_count = t.garment.particle_count,
                          .position = t.position,
                          .velocity = t.velocity,
                          .origin = t.cloth.origin,
                          .capsules = &t.world.capsules,
                          .bodies = t.world.bodies.get(),
                          .meshes = t.world.mesh_pointers.data(),
                          .mesh_count = static_cast<std::uint32_t>(t.world.mesh_pointers.size()),
                          .thickness = t.settings.thickness,
                          .dt = t.frame_dt,
                          .reach = reach,
                          .carry = carry});
#else
  return 0.0f;
#endif
}

bool waits(ClothTick& t) {
  ClothRecord& cloth = t.cloth;
  const std::uint32_t ticks = takes_one_tick_of(cloth);
  const auto place = static_cast<std::uint32_t>(&cloth - t.world.clothes.data());
  if (cloth.young == 0.0f && (t.world.turn + place) % ticks != 0) {
    t.carry = best_motion(t.pin_previous, t.pin_next, t.garment.pins.size());
    cloth.travelled += travel_of_bodies(t, kReachATick * static_cast<float>(ticks), t.carry);
    if (cloth.travelled <= 1.0f) return true;
  }
  cloth.travelled = 0.0f;
  cloth.young = std::max(cloth.young - t.frame_dt, 0.0f);
  return false;
}

void carry_with_pins(ClothTick& t) {
  const std::size_t pins = t.garment.pins.size();
  t.carry = best_motion(t.pin_previous, t.pin_next, pins);
  RigidCarry cloth{
      .motion = t.carry, .particle_count = t.garment.particle_count, .position = t.position, .velocity = t.velocity};
  if (t.world.held.size() != 0) cloth.held = t.world.held.view().from(t.cloth.particle_begin);
  run(cloth);
  for (std::size_t k = 0; k < pins; ++k) t.position.set(t.garment.pins[k], t.pin_next[k]);
  t.cloth.bending_left = 0.0f;
  t.cloth.self_pair_count = kNone;
}

void carry_surface([[maybe_unused]] ClothTick& t) {
#ifdef PLEAT_WITH_SMOOTHING
  const TessellationPattern& pattern = *t.cloth.pattern();
  run(SurfaceCarry{.motion = t.carry,
                   .vertex_count = pattern.vertex_count,
                   .shaded_count = pattern.shaded_count(),
                   .position = t.drawn_position,
                   .normal = t.drawn_normal,
                   .tangent = t.settings.tangents != 0 ? t.drawn_tangent : Vec3View{}});
#endif
}

}  // namespace pleat
