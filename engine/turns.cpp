#include "engine/turns.h"

#include <algorithm>
#include <array>

#include "engine/budget.h"
#include "engine/run.h"
#include "systems/rigid_carry.h"
#include "systems/rigid_fit.h"
#ifdef PLEAT_WITH_SMOOTHING
#include "systems/surface_carry.h"
#endif
#ifdef PLEAT_WITH_COLLISION
#include "systems/contact_row.h"
#include "systems/substep_bound.h"
#endif

namespace pleat {
namespace {

constexpr float kReachATick = 0.0625f;  // of bodies between turns, for each tick of as many as the cloth takes one of

#ifdef PLEAT_WITH_COLLISION
/// How far a cloth that is carried goes into planes, in such shares of what contact looks for them.
float travel_into_planes(const ClothTick& t, float reach) {
  const float room = std::min(reach * (kLeastMargin + t.settings.thickness), kRecoverySpeed * t.frame_dt);
  float most = 0.0f;
  for (const PlaneCollider& plane : t.world.planes) {
    if (!plane.meets(t.settings.collides_with)) continue;
    const PlanePose begin(plane, 0.0f, t.cloth.origin), end(plane, 1.0f, t.cloth.origin);
    float before = 0.0f, after = 0.0f;  // depth, m
    for (std::uint32_t i = 0; i < t.garment.particle_count; ++i) {
      const Vec3 x = t.position[i];
      before = std::max(before, begin.height - dot(begin.normal, x));
      after = std::max(after, end.height - dot(end.normal, t.carry.apply(x)));
    }
    most = std::max(most, (after - before) / room);
  }
  return most;
}
#endif

/// Old enough, and nothing fades that would be seen to.
bool may_wait(const ClothRecord& cloth) { return cloth.young == 0.0f && !shows_fading(cloth); }

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
                          .collides_with = t.settings.collides_with,
                          .thickness = t.settings.thickness,
                          .dt = t.frame_dt,
                          .reach = reach,
                          .carry = carry});
#else
  return 0.0f;
#endif
}

void begin_turns(World& world) {
  world.turn = (world.turn + 1) % kTicksParted.back();
  std::array<std::uint32_t, kMostGivenUp + 1> waiting{};  // by steps given up
  for (ClothRecord& cloth : world.clothes) {
    const std::uint32_t ticks = takes_one_tick_of(cloth);
    cloth.carried = ticks > 1 && (world.turn + waiting[steps_given_up(cloth)]++) % ticks != 0;
  }
}

bool waits(ClothTick& t) {
  ClothRecord& cloth = t.cloth;
  if (cloth.carried && may_wait(cloth)) {
    t.carry = best_motion(t.pin_previous, t.pin_next, t.garment.pins.size());
    const float reach = kReachATick * static_cast<float>(takes_one_tick_of(cloth));
    cloth.travelled += travel_of_bodies(t, reach, t.carry);
#ifdef PLEAT_WITH_COLLISION
    cloth.travelled += travel_into_planes(t, reach);
#endif
    if (cloth.travelled <= 1.0f) return true;
  }
  cloth.carried = false;
  cloth.travelled = 0.0f;
  cloth.young = std::max(cloth.young - t.frame_dt, 0.0f);
  return false;
}

void carry_with_pins(ClothTick& t) {
  const std::size_t pins = t.garment.pins.size();
  RigidCarry cloth{
      .motion = t.carry, .particle_count = t.garment.particle_count, .position = t.position, .velocity = t.velocity};
  if (t.world.held.size() != 0) cloth.held = t.world.held.view().from(t.cloth.particle_begin);
  run(cloth);
  for (std::size_t k = 0; k < pins; ++k) t.position.set(t.garment.pins[k], t.pin_next[k]);
  t.cloth.bending_left = 0.0f;
  t.cloth.self_pair_count = kNone;
}

#ifdef PLEAT_WITH_SMOOTHING
void carry_surface(ClothTick& t) {
  const TessellationPattern& pattern = *t.cloth.pattern();
  run(SurfaceCarry{.motion = t.carry,
                   .vertex_count = pattern.vertex_count,
                   .shaded_count = pattern.shaded_count(),
                   .position = t.drawn_position,
                   .normal = t.drawn_normal,
                   .tangent = t.settings.tangents != 0 ? t.drawn_tangent : Vec3View{}});
}
#endif

}  // namespace pleat
