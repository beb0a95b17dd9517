#include "engine/border.h"
#include "engine/budget.h"
#include "engine/calls.h"
#include "engine/schedule.h"
#include "engine/sleep.h"

namespace pleat::call {
namespace {

const pleat_world_def& default_world() {
  static const pleat_world_def def = [] {
    pleat_world_def d{};
    d.size = sizeof d;
    d.gravity[1] = -9.81f;
    d.air_density = 1.225f;
    d.max_substep = 1.0f / 360.0f;
    d.gust_frequency = 2.0f;
    d.workers = 1;
    return d;
  }();
  return def;
}

void need_small(const char* name, const float v[3], double most) {
  need_finite(name, v);
  for (int k = 0; k < 3; ++k) need_range(name, v[k], -most, most);
}

void need_gust(float gust, float frequency) {
  need_range("gust", gust, 0.0, 1e3);
  need_range("gust_frequency", frequency, 1e-3, 1e3);
}

constexpr double kLongest = 1e6;                       // ms
constexpr double kMostGravity = 1e4, kMostWind = 1e4;  // m/s2, m/s

}  // namespace

pleat_result world_def_init(pleat_world_def* def, size_t size) {
  return init_def("world_def_init", def, size, default_world());
}

pleat_result world_create(const pleat_world_def* given, pleat_world** world) {
  pleat_world_def def{};
  return guarded(def, "world_create", [&] {
    need_pointer("world", world);
    def = read_def("def", given, default_world());
    need_small("gravity", def.gravity, kMostGravity);
    need_small("wind", def.wind, kMostWind);
    need_range("air_density", def.air_density, 0.0, 1e4);
    need_range("max_substep", def.max_substep, 1e-5, 1.0);
    need_gust(def.gust, def.gust_frequency);
    need_range("workers", def.workers, 1, PLEAT_MAX_WORKERS);
    if ((def.allocate == nullptr) != (def.free == nullptr)) refuse("allocate and free must both be given, or neither");
    HostMemory memory(def.allocate, def.free, def.memory_user);
    *world = reinterpret_cast<pleat_world*>(std::pmr::polymorphic_allocator<>(&memory).new_object<World>(def));
  });
}

void world_destroy(pleat_world* handle) {
  if (handle == nullptr) return;
  World* world = reinterpret_cast<World*>(handle);
  if (world->busy) return world->log(PLEAT_LOG_ERROR, "world_destroy: the world is busy, and stays");
  HostMemory memory(world->def.allocate, world->def.free, world->def.memory_user);
  std::pmr::polymorphic_allocator<>(&memory).delete_object(world);
}

pleat_result world_step(pleat_world* handle, float dt) {
  return guarded(as_world(handle), "world_step", [&] {
    World& world = need_world(handle);
    if (dt == 0.0f) return;
    need_range("dt", dt, 1e-6, 1.0);
    tick(world, dt);
  });
}

pleat_result world_set_gravity(pleat_world* handle, const float gravity[3]) {
  return guarded(as_world(handle), "world_set_gravity", [&] {
    World& world = need_world(handle);
    need_small("gravity", gravity, kMostGravity);
    if (std::equal(gravity, gravity + 3, world.def.gravity)) return;
    std::copy_n(gravity, 3, world.def.gravity);
    replan(world);
  });
}

pleat_result world_set_wind(pleat_world* handle, const float wind[3]) {
  return guarded(as_world(handle), "world_set_wind", [&] {
    World& world = need_world(handle);
    need_small("wind", wind, kMostWind);
    if (std::equal(wind, wind + 3, world.def.wind)) return;
    std::copy_n(wind, 3, world.def.wind);
    wake_all(world);
  });
}

pleat_result world_set_gust(pleat_world* handle, float gust, float frequency, uint32_t seed) {
  return guarded(as_world(handle), "world_set_gust", [&] {
    World& world = need_world(handle);
    need_gust(gust, frequency);
    const pleat_world_def& old = world.def;
    if (gust == old.gust && frequency == old.gust_frequency && seed == old.gust_seed) return;
    world.def.gust = gust;
    world.def.gust_frequency = frequency;
    world.def.gust_seed = seed;
    replan(world);
  });
}

pleat_result world_keep_budget(pleat_world* handle, float budget_ms, float cost_ms) {
  return guarded(as_world(handle), "world_keep_budget", [&] {
    World& world = need_world(handle);
    need_range("budget_ms", budget_ms, 0.0, kLongest);
    need_range("cost_ms", cost_ms, 0.0, kLongest);
    keep_budget(world, budget_ms, cost_ms);
  });
}

pleat_result world_stats(const pleat_world* handle, pleat_stats* stats) {
  return guarded(as_world(handle), "world_stats", [&] {
    const World& world = need_world(handle);
    pleat_stats all{};
    all.ticks = world.ticks;
    all.substeps = world.substeps;
    all.particle_contacts = world.stats.particle_contacts;
    all.face_contacts = world.stats.face_contacts;
    all.self_contacts = world.stats.self_contacts;
    all.contacts_dropped = world.stats.contacts_dropped;
    all.edges_skipped = world.stats.edges_skipped;
    all.nonfinite_restored = world.stats.nonfinite_restored;
    all.fast_bodies = world.stats.fast_bodies;
    all.stiffness_lowered = world.stats.stiffness_lowered;
    all.teleports = world.stats.teleports;
    all.rollbacks = world.stats.rollbacks;
    all.fallbacks = world.stats.fallbacks;
    all.sleeping = world.stats.sleeping;
    for (const ClothRecord& cloth : world.clothes) {
      if (!cloth.visible) ++all.invisible;
      if (gives_up_folds(cloth)) ++all.folds_given_up;
      if (gives_up_substeps(cloth)) ++all.substeps_given_up;
      if (cloth.visible && takes_one_tick_of(cloth) > 1) ++all.ticks_given_up;
    }
    all.allocations = world.memory.allocations();
    all.bytes = world.memory.bytes();
    all.peak_bytes = world.memory.peak_bytes();
    write_sized("stats", stats, all);
  });
}

pleat_result world_explain(pleat_world* handle, pleat_text_fn write, void* user) {
  return guarded(as_world(handle), "world_explain", [&] {
    const World& world = need_world(handle);
    if (write == nullptr) refuse("write is null");
    explain(world, write, user);
  });
}

}  // namespace pleat::call
