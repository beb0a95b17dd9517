#include "engine/teleport.h"

#include <string>
#include <utility>

#include "engine/layers.h"
#include "engine/origin.h"
#include "engine/schedule_row.h"
#include "engine/sleep.h"
#include "systems/pin_jump.h"
#include "systems/rigid_carry.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/body_carry.h"
#endif

namespace pleat {
namespace {

void carry_bodies([[maybe_unused]] World& world, [[maybe_unused]] const RigidMotion& jump) {
#ifdef PLEAT_WITH_COLLISION
  carry_along(jump, world.capsules);
  for (MeshRecord& record : world.meshes) carry_along(jump, record.mesh);
  for (PlaneCollider& plane : world.planes) carry_along(jump, plane);
#endif
}

/// jump: from the cloth's origin, as its positions.
void carry(ClothTick& t, const RigidMotion& jump) {
  World& world = t.world;
  const Vec3 far = whole_cells(jump.to - jump.from);  // which the origin goes, so that no position is ever far from it
  const RigidMotion near{jump.from, jump.to - far, jump.rotation};
  RigidCarry cloth{
      .motion = near, .particle_count = t.garment.particle_count, .position = t.position, .velocity = t.velocity};
  if (world.held.size() != 0) cloth.held = world.held.view().from(t.cloth.particle_begin);
  run(cloth);
  const Vec3View previous = world.pin_previous.view().from(t.cloth.pin_begin),
                 next = world.pin_next.view().from(t.cloth.pin_begin);
  for (std::size_t k = 0; k < t.garment.pins.size(); ++k) {
    previous.set(k, near.apply(previous[k]));
    next.set(k, t.cloth.pins_told ? next[k] - far : previous[k]);
  }
  if (std::exchange(world.last_jump, world.ticks) != world.ticks) wake_around_bodies(world, t.worker);
  carry_bodies(world, jump.moved(t.cloth.origin));
  t.cloth.origin += far;
  t.cloth.bending_left = 0.0f;
  t.cloth.travelled = kDue;
  wake(t.cloth);
  t.cloth.self_pair_count = kNone;
  forget_layer_pairs(world, t.cloth);
}

void report_jump(ClothTick& t, const RigidMotion& jump) {
  if (t.cloth.said_jump) return;
  t.cloth.said_jump = true;
  t.world.log(PLEAT_LOG_INFO, "a cloth's pins moved by " + std::to_string(length(jump.to - jump.from)) +
                                  " m in one tick: taken for a jump, the cloth is carried along");
}

}  // namespace

void teleport(ClothTick& t) {
  ClothRecord& cloth = t.cloth;
  const bool declared = cloth.declared_jump.has_value();
  if (declared) {
    carry(t, cloth.declared_jump->moved(cloth.origin * -1.0f));
    cloth.pin_velocity = rotate(cloth.declared_jump->rotation, cloth.pin_velocity);
  }
  cloth.declared_jump.reset();
  std::optional<RigidMotion> found;
  if (t.garment.pins.size() != 0) {
    const Vec3 before = cloth.pin_velocity;
    cloth.pin_velocity = mean_motion(t.pin_previous, t.pin_next, t.garment.pins.size()) * (1.0f / t.frame_dt);
    if (t.settings.teleport_speed > 0.0f) {
      found = run(PinJump{.count = t.garment.pins.size(),
                          .previous = t.pin_previous,
                          .next = t.pin_next,
                          .speed = t.settings.teleport_speed,
                          .velocity = cloth.pin_velocity,
                          .velocity_before = before});
    }
    if (found) carry(t, *found), report_jump(t, *found);
  }
  if (declared || found) ++t.worker.stats.teleports;
}

}  // namespace pleat
