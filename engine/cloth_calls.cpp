#include <cstddef>

#include "engine/border.h"
#include "engine/budget.h"
#include "engine/calls.h"
#include "engine/cloth_tick.h"
#include "engine/layers.h"
#include "engine/origin.h"
#include "engine/schedule.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/self_candidates.h"
#endif

namespace pleat::call {
namespace {

const pleat_cloth_def& default_cloth() {
  static const pleat_cloth_def def = [] {
    pleat_cloth_def d{};
    d.size = sizeof d;
    d.settings = {.size = sizeof(pleat_cloth_settings),
                  .integrator = PLEAT_INTEGRATOR_PROJECTED,
                  .substeps = 0,
                  .sweeps = 3,
                  .density = 0.2f,
                  .stiffness = 335.0f,
                  .stretch_limit = 0.001f,
                  .bend_stiffness = 5e-5f,
                  .edge_damping = 4.0f,
                  .bend_damping = 4.0f,
                  .air_damping = 0.1f,
                  .drag_coefficient = 0.0f,
                  .thickness = 0.005f,
                  .friction = 0.2f,
                  .face_response = PLEAT_FACE_RESPONSE_WEIGHTED,
                  .surface = kHasSmoothing ? PLEAT_SURFACE_PLEAT : PLEAT_SURFACE_FLAT,
                  .level = PLEAT_LEVEL_FAN,
                  .lift_coefficient = 0.0f,
                  .inner_friction = 0.1f,
                  .fold_sweeps = 0,
                  .self_distance = 0.0f,
                  .tangents = 0,
                  .layer = 0,
                  .buckling_strain = 0.01f,
                  .teleport_speed = 50.0f,
                  .sleep_speed = 0.0f,
                  .collides_with = kAllGroups,
                  .reserved = 0};
    return d;
  }();
  return def;
}

void need_settings(const pleat_cloth_settings& s) {
  need_range("integrator", s.integrator, 0, PLEAT_INTEGRATOR_IMPLICIT_EULER);
  need_range("substeps", s.substeps, 0, kMostSubsteps);
  need_range("sweeps", s.sweeps, 1, 64);
  need_range("density", s.density, 1e-6, 1e4);
  need_range("stiffness", s.stiffness, 0, 1e12);
  need_range("stretch_limit", s.stretch_limit, 0, 1e6);
  need_range("bend_stiffness", s.bend_stiffness, 0, 1e6);
  need_range("edge_damping", s.edge_damping, 0, 1e6);
  need_range("bend_damping", s.bend_damping, 0, 1e6);
  need_range("air_damping", s.air_damping, 0, 1e6);
  need_range("drag_coefficient", s.drag_coefficient, 0, 1e3);
  need_range("lift_coefficient", s.lift_coefficient, 0, 1e3);
  need_range("thickness", s.thickness, 0, 1);
  need_range("friction", s.friction, 0, 10);
  need_range("face_response", s.face_response, 0, PLEAT_FACE_RESPONSE_WHOLE);
  need_range("surface", s.surface, 0, PLEAT_SURFACE_ARC_PN);
  need_range("level", s.level, 0, PLEAT_LEVEL_MAX);
  need_range("inner_friction", s.inner_friction, 0, 1e6);
  need_range("fold_sweeps", s.fold_sweeps, 0, 64);
  need_range("self_distance", s.self_distance, 0, 1);
  need_compiled(kHasCollision || s.self_distance == 0.0f, "self_distance", "PLEAT_COLLISION");
  need_range("tangents", s.tangents, 0, 1);
  need_range("layer", s.layer, 0, 15);
  need_range("buckling_strain", s.buckling_strain, 0, 1);
  need_compiled(kHasCollision || s.layer == 0, "layer", "PLEAT_COLLISION");
  need_range("teleport_speed", s.teleport_speed, 0, 1e9);
  need_range("sleep_speed", s.sleep_speed, 0, 1);
  need_range("reserved", s.reserved, 0, 0);
  need_compiled(kHasSmoothing || s.surface == PLEAT_SURFACE_FLAT, "a curved surface", "PLEAT_SMOOTHING");
}

/// Coarse cloth cannot keep what the host asks for: it is told what it gets instead.
void warn_of_self_distance(const World& world, const Garment& garment, const pleat_cloth_settings& s) {
#ifdef PLEAT_WITH_COLLISION
  const float most = SelfCandidates::most_distance(garment);
  if (s.self_distance <= most) return;
  world.log(PLEAT_LOG_WARNING, "self_distance is " + std::to_string(s.self_distance) + " m; the garment's edges are " +
                                   std::to_string(garment.mean_edge_length) + " m long on average, so " +
                                   std::to_string(most) + " m is kept");
#else
  (void)world, (void)garment, (void)s;
#endif
}

void move_pins_to_particles(World& world, const ClothRecord& cloth) {
  const Garment& g = cloth.garment();
  for (std::uint32_t k = 0; k < g.pins.size(); ++k) {
    const Vec3 x = world.particles.position.view()[cloth.particle_begin + g.pins[k]];
    world.pin_previous.view().set(cloth.pin_begin + k, x);
    world.pin_next.view().set(cloth.pin_begin + k, x);
  }
}

/// On average, m/s.
Vec3 velocity_of_pins(const World& world, const ClothRecord& cloth) {
  const Column<std::uint32_t>& pins = cloth.garment().pins;
  Vec3 sum;
  for (const std::uint32_t pin : pins) sum += world.particles.velocity.view()[cloth.particle_begin + pin];
  return sum * (1.0f / static_cast<float>(std::max<std::size_t>(pins.size(), 1)));
}

/// Where it is allowed to be.
void need_room_for_jump(const World& world, const ClothRecord& cloth, const RigidMotion& jump) {
  const ConstVec3View x = world.particles.position.view().from(cloth.particle_begin);
  for (std::uint32_t i = 0; i < cloth.garment().particle_count; ++i) {
    const Vec3 there = jump.apply(x[i] + cloth.origin);
    for (const float place : {there.x, there.y, there.z}) {
      if (std::abs(place) <= kFarthest) continue;
      refuse("to would take the cloth to " + std::to_string(place) + ", beyond " + std::to_string(kFarthest) + " m");
    }
  }
}

}  // namespace

pleat_result cloth_def_init(pleat_cloth_def* def, size_t size) {
  constexpr std::size_t kBegin = offsetof(pleat_cloth_def, settings);
  static_assert(kBegin + sizeof def->settings == sizeof *def, "padding behind settings would pass for more of them");
  const pleat_result result = init_def("cloth_def_init", def, size, default_cloth());
  if (result == PLEAT_OK && size >= kBegin + sizeof def->settings.size) {
    def->settings.size = static_cast<std::uint32_t>(size - kBegin);
  }
  return result;
}

pleat_result cloth_create(pleat_world* handle, const pleat_cloth_def* given, pleat_cloth* cloth) {
  return guarded(as_world(handle), "cloth_create", [&] {
    World& world = need_world(handle);
    need_pointer("cloth", cloth);
    const pleat_cloth_def def = read_def("def", given, default_cloth());
    GarmentRecord& source = *world.garments[need_handle("garment", world.garment_handles, def.garment)];
    need_settings(def.settings);
    const std::uint32_t count = def.positions != nullptr ? source.garment.particle_count : 0;
    const HostVectors start("positions", def.positions, def.position_stride, count);
    const Handle added = add_cloth(world, source, def.settings, def.positions, start.stride());
    try {
      refresh(world, world.clothes.back());
    } catch (...) {
      remove_cloth(world, static_cast<std::uint32_t>(world.clothes.size() - 1));
      throw;
    }
    warn_of_self_distance(world, source.garment, def.settings);
    *cloth = {added.index, added.generation};
  });
}

pleat_result cloth_destroy(pleat_world* handle, pleat_cloth cloth) {
  return guarded(as_world(handle), "cloth_destroy", [&] {
    World& world = need_world(handle);
    remove_cloth(world, need_handle("cloth", world.cloth_handles, cloth));
  });
}

pleat_result cloth_get(const pleat_world* handle, pleat_cloth cloth, pleat_cloth_settings* settings) {
  return guarded(as_world(handle), "cloth_get",
                 [&] { write_sized("settings", settings, need_cloth(need_world(handle), cloth).settings); });
}

pleat_result cloth_set(pleat_world* handle, pleat_cloth cloth, const pleat_cloth_settings* settings) {
  return guarded(as_world(handle), "cloth_set", [&] {
    World& world = need_world(handle);
    ClothRecord& record = need_cloth(world, cloth);
    const pleat_cloth_settings wanted = read_def("settings", settings, record.settings);
    need_settings(wanted);
    const pleat_cloth_settings old = record.settings;
    if (same_bytes(wanted, old)) return draw(world, record);
    set_cloth(world, record, wanted);
    try {
      refresh(world, record);
    } catch (...) {
      set_cloth(world, record, old);
      refresh(world, record);
      throw;
    }
    warn_of_self_distance(world, record.garment(), wanted);
  });
}

pleat_result cloth_set_importance(pleat_world* handle, pleat_cloth cloth, float importance) {
  return guarded(as_world(handle), "cloth_set_importance", [&] {
    ClothRecord& record = need_cloth(need_world(handle), cloth);
    need_range("importance", importance, 0.0, double{kMostImportance});
    record.importance = importance;
  });
}

pleat_result cloth_set_visible(pleat_world* handle, pleat_cloth cloth, uint32_t visible) {
  return guarded(as_world(handle), "cloth_set_visible", [&] {
    World& world = need_world(handle);
    ClothRecord& record = need_cloth(world, cloth);
    if (record.visible == (visible != 0)) return;
    record.visible = visible != 0;
    record.sides_known = false;
    replan(world, record);
    if (record.visible) draw(world, record);
  });
}

pleat_result cloth_info(const pleat_world* handle, pleat_cloth cloth, pleat_cloth_info* info) {
  return guarded(as_world(handle), "cloth_info", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    const Garment& g = record.garment();
    const TessellationPattern* pattern = record.pattern();
    const pleat_cloth_info all{.size = sizeof all,
                               .particles = g.particle_count,
                               .triangles = g.face_count,
                               .drawn_vertices = pattern != nullptr ? pattern->shaded_count() : g.particle_count,
                               .drawn_triangles = pattern != nullptr ? pattern->triangle_count : g.face_count,
                               .substeps = record.substeps_taken,
                               .bytes = bytes_of(world, record)};
    write_sized("info", info, all);
  });
}

pleat_result cloth_move_pins(pleat_world* handle, pleat_cloth cloth, const float* positions, uint32_t stride,
                             uint32_t count) {
  return guarded(as_world(handle), "cloth_move_pins", [&] {
    World& world = need_world(handle);
    ClothRecord& record = need_cloth(world, cloth);
    const std::size_t pins = record.garment().pins.size();
    if (count != pins)
      refuse("count is " + std::to_string(count) + ", the garment has " + std::to_string(pins) + " pins");
    const HostVectors next("positions", positions, stride, count);
    for (std::uint32_t k = 0; k < count; ++k) world.pin_next.view().set(record.pin_begin + k, next[k] - record.origin);
    record.pins_told = true;
  });
}

pleat_result cloth_read_particles(const pleat_world* handle, pleat_cloth cloth, float* positions, float* velocities,
                                  uint32_t capacity) {
  return guarded(as_world(handle), "cloth_read_particles", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    const std::uint32_t count = record.garment().particle_count;
    need_capacity("capacity", capacity, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3 x = world.particles.position.view()[record.particle_begin + i] + record.origin;
      const Vec3 v = world.particles.velocity.view()[record.particle_begin + i];
      if (positions != nullptr) std::memcpy(positions + 3 * i, &x, sizeof x);
      if (velocities != nullptr) std::memcpy(velocities + 3 * i, &v, sizeof v);
    }
  });
}

pleat_result cloth_write_particles(pleat_world* handle, pleat_cloth cloth, const float* positions,
                                   const float* velocities, uint32_t count) {
  return guarded(as_world(handle), "cloth_write_particles", [&] {
    World& world = need_world(handle);
    ClothRecord& record = need_cloth(world, cloth);
    const std::uint32_t particles = record.garment().particle_count;
    if (count != particles) {
      refuse("count is " + std::to_string(count) + ", the garment has " + std::to_string(particles) + " particles");
    }
    const HostVectors x("positions", positions, 0, count);
    const HostVectors v("velocities", velocities, 0, velocities != nullptr ? count : 0, 3, kFastest);
    for (std::uint32_t i = 0; i < count; ++i) {
      world.particles.position.view().set(record.particle_begin + i, x[i] - record.origin);
      world.particles.velocity.view().set(record.particle_begin + i, velocities != nullptr ? v[i] : Vec3{});
    }
    move_pins_to_particles(world, record);
    recentre(world, record);
    record.pin_velocity = velocity_of_pins(world, record);
    record.pins_told = false;
    record.declared_jump.reset();
    record.settling = velocities == nullptr ? kSettling : 0.0f;
    record.young = kYoung;
    record.sides_known = false;
    forget_motion(world, record);
    forget_layer_pairs(world, record);
    refresh(world, record);
  });
}

pleat_result cloth_teleport(pleat_world* handle, pleat_cloth cloth, const float from[3], const float to[3],
                            const float rotation[4]) {
  return guarded(as_world(handle), "cloth_teleport", [&] {
    World& world = need_world(handle);
    ClothRecord& record = need_cloth(world, cloth);
    const Vec3 begin = need_place("from", from), end = need_place("to", to);
    RigidMotion jump{begin, end, rotation != nullptr ? need_rotation("rotation", rotation) : Quaternion{}};
    if (record.declared_jump) jump = record.declared_jump->then(jump).about(record.origin);
    need_room_for_jump(world, record, jump);
    record.declared_jump = jump;
  });
}

}  // namespace pleat::call
