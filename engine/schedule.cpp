#include "engine/schedule.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/cloth_tick.h"
#include "engine/layers.h"
#include "engine/origin.h"
#include "engine/room.h"
#include "engine/run.h"
#include "engine/schedule_table.h"
#include "engine/sleep.h"
#include "engine/turns.h"
#include "systems/frequency_bound.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/collision_bodies.h"
#endif

namespace pleat {
namespace {

Plan plan_of(const World& world, const ClothRecord& cloth) {
  Plan plan = 0;
  const std::span<const Row> rows = schedule_table();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].left_out(world, cloth) == nullptr) plan |= Plan{1} << r;
  }
  return plan;
}

/// The plans of all cloths; those that sleep go on sleeping.
void plan_anew(World& world) {
  for (const ClothRecord& cloth : world.clothes) make_room(world, cloth);
  for (ClothRecord& cloth : world.clothes) replan(world, cloth);
}

/// The cloths of a layer, which do not see each other.
struct LayerTasks {
  World& world;
  std::uint32_t layer;
  float dt;

  static void tick_one(std::uint32_t index, std::uint32_t worker, void* context) {
    const auto& [world, layer, dt] = *static_cast<const LayerTasks*>(context);
    if (index >= world.clothes.size() || worker >= world.workers.size()) return;  // a host's mistake
    ClothRecord& cloth = world.clothes[index];
    if (cloth.settings.layer != layer || cloth.last_tick == world.ticks) return;
    cloth.last_tick = world.ticks;
    tick_cloth(world, world.workers[worker], cloth, dt);
  }
};

void tick_layer(World& world, std::uint32_t layer, float dt) {
  LayerTasks tasks{world, layer, dt};
  const auto count = static_cast<std::uint32_t>(world.clothes.size());
  if (world.pool != nullptr) {
    world.pool->run(LayerTasks::tick_one, count, &tasks);
  } else if (world.workers.size() > 1) {
    world.def.parallel_for(LayerTasks::tick_one, count, &tasks, world.def.parallel_user);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    LayerTasks::tick_one(i, 0, &tasks);  // all, or what a host forgot
    if (world.clothes[i].settings.layer != layer) continue;
    report_troubles(world, world.clothes[i]);
    publish_layer(world, i);
  }
}

/// What the workers have counted goes to the world.
void collect_counts(World& world) {
  for (Worker& worker : world.workers) {
    world.stats += std::exchange(worker.stats, {});
    world.substeps += std::exchange(worker.substeps, 0);
  }
}

/// What was next becomes previous: a pin or body that is not moved again stands still.
void settle_poses(World& world) {
  for (ClothRecord& cloth : world.clothes) cloth.pins_told = false;
  copy(world.pin_previous.view(), world.pin_next.view(), world.pin_next.size());
  CapsuleColumns& c = world.capsules;
  copy(c.previous_a.view(), c.next_a.view(), c.size());
  copy(c.previous_b.view(), c.next_b.view(), c.size());
  for (MeshRecord& record : world.meshes) {
    if (record.stale_ticks == 0) continue;
    copy(record.mesh.previous.view(), record.mesh.next.view(), record.mesh.next.size());
    record.mesh.previous_pose = record.mesh.next_pose;
    record.mesh.bow = 0.0f;
  }
  for (PlaneCollider& plane : world.planes) plane.previous = plane.next;
}

#ifdef PLEAT_WITH_COLLISION
void file_capsules(World& world) {
  world.bodies->update_capsules(world.capsules);
  world.capsules_filed = true;
}
#endif

/// Files the bodies of this tick in their trees.
void update_bodies([[maybe_unused]] World& world) {
#ifdef PLEAT_WITH_COLLISION
  if (world.bodies == nullptr) return;
  const pleat_world_def& host = world.def;
  if (host.stage != nullptr) host.stage("body_refit", 1, host.stage_user);
  file_capsules(world);
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    MeshRecord& record = world.meshes[i];
    if (record.stale_ticks == 0) continue;
    world.bodies->update_mesh(i, record.mesh);
    --record.stale_ticks;
  }
  if (host.stage != nullptr) host.stage("body_refit", 0, host.stage_user);
#endif
}

const char* phase_name(Phase phase) {
  switch (phase) {
    case Phase::kFrameBegin:
      return "frame begin";
    case Phase::kSubstepBegin:
      return "substep begin";
    case Phase::kStage:
      return "stage";
    case Phase::kContact:
      return "contact";
    case Phase::kSweep:
      return "sweep";
    case Phase::kFriction:
      return "friction";
    case Phase::kSubstepEnd:
      return "substep end";
    case Phase::kCheck:
      return "check";
    case Phase::kFrameEnd:
      return "frame end";
    case Phase::kCarried:
      return "carried";
  }
  return "";
}

}  // namespace

ClothTick::ClothTick(World& w, Worker& scratch, ClothRecord& c)
    : world(w),
      worker(scratch),
      cloth(c),
      garment(c.garment()),
      settings(c.settings),
      air{w.def.wind[0], w.def.wind[1], w.def.wind[2]},
      position(w.particles.position.view().from(c.particle_begin)),
      velocity(w.particles.velocity.view().from(c.particle_begin)),
      force(w.particles.force.view().from(c.particle_begin)),
      previous(w.particles.previous.view().from(c.particle_begin)),
      predicted(w.particles.predicted.view().from(c.particle_begin)),
      start(w.particles.start.view().from(c.particle_begin)),
      start_velocity(w.particles.start_velocity.view().from(c.particle_begin)),
      inverse_mass(w.particles.inverse_mass.data() + c.particle_begin),
      mass(w.particles.mass.data() + c.particle_begin),
      pin_previous(w.pin_previous.view().from(c.pin_begin)),
      pin_next(w.pin_next.view().from(c.pin_begin)) {
  if (w.surface.normal.size() != 0) normal = w.surface.normal.view().from(c.normal_begin);
  if (w.surface.fold.size() != 0) {
    fold = w.surface.fold.view().from(c.edge_begin);
    fold_height = w.surface.fold_height.data() + c.edge_begin;
    fold_side = w.surface.fold_side.data() + c.edge_begin;
  }
  if (w.drawn.position.size() != 0) {
    drawn_position = w.drawn.position.view().from(c.drawn_begin);
    drawn_normal = w.drawn.normal.view().from(c.drawn_begin);
  }
  if (w.drawn.tangent.size() != 0) {
    drawn_tangent = w.drawn.tangent.view().from(c.drawn_begin);
    drawn_handedness = w.drawn.handedness.data() + c.drawn_begin;
  }
}

void refresh(World& world, ClothRecord& cloth) {
  make_room(world, cloth);
  cloth.rates = run(FrequencyBound{.garment = &cloth.garment(),
                                   .inverse_mass = world.particles.inverse_mass.data() + cloth.particle_begin});
  cloth.bending_left = 0.0f;
  wake(cloth);
  cloth.plan = plan_of(world, cloth);
  draw(world, cloth);
}

void draw(World& world, ClothRecord& cloth) {
  const Busy busy(world);
#ifdef PLEAT_WITH_COLLISION
  if (world.bodies != nullptr && !world.capsules_filed) file_capsules(world);
#endif
  ClothTick t(world, world.workers[0], cloth);
  t.t1 = t.t0;  // between ticks bodies are where the last one left them
  run_phase(t, Phase::kFrameEnd);
  collect_counts(world);
}

void replan(const World& world, ClothRecord& cloth) { cloth.plan = plan_of(world, cloth); }

void replan(World& world) {
  plan_anew(world);
  wake_all(world);
}

BodyCensus body_census(const World& world) {
  const std::size_t capsules = world.capsules.size();
  return {.any = !world.colliders.empty(),
          .any_capsule = capsules != 0,
          .any_plane = world.planes.size() != 0,
          .capsule_room = capsule_room(capsules),
          .meshes = world.meshes.size()};
}

void replan(World& world, const BodyCensus& before, std::uint32_t groups) {
  if (body_census(world) != before) plan_anew(world);
  wake_who_meets(world, groups);
}

void tick(World& world, float dt) {
  const Busy busy(world);
  ++world.ticks;
  world.stats.particle_contacts = world.stats.face_contacts = world.stats.self_contacts = world.stats.sleeping = 0;
  for (ClothRecord& cloth : world.clothes) {
    ClothTick t(world, world.workers[0], cloth);
    t.frame_dt = dt;
    run_phase(t, Phase::kFrameBegin);
    recentre(world, cloth);
  }
  begin_turns(world);
  update_bodies(world);
  begin_layers(world);
  const std::uint32_t top = top_layer(world);
  for (std::uint32_t layer = 0; layer <= top; ++layer) tick_layer(world, layer, dt);
  collect_counts(world);
  world.time += static_cast<double>(dt);
  settle_poses(world);
}

void explain(const World& world, pleat_text_fn write, void* user) {
  const Busy busy(world);
  for (const Row& row : schedule_table()) {
    std::string line = row.name;
    line.resize(std::max<std::size_t>(line.size() + 1, 26), ' ');
    line += phase_name(row.phase);
    line.resize(std::max<std::size_t>(line.size() + 1, 42), ' ');
    std::size_t running = 0;
    const char* why = "no cloth";
    for (const ClothRecord& cloth : world.clothes) {
      const char* reason = row.left_out(world, cloth);
      if (reason == nullptr) {
        ++running;
      } else {
        why = reason;
      }
    }
    if (running == 0) {
      line += std::string("left out: ") + why;
    } else if (running == world.clothes.size()) {
      line += "run";
    } else {
      line += "run for " + std::to_string(running) + " of " + std::to_string(world.clothes.size()) +
              " cloths, left out of the others: " + why;
    }
    write(line.c_str(), user);
  }
#ifndef PLEAT_WITH_COLLISION
  write("collision                                 left out: not compiled in (PLEAT_COLLISION=OFF)", user);
#endif
#ifndef PLEAT_WITH_SMOOTHING
  write("smoothing                                 left out: not compiled in (PLEAT_SMOOTHING=OFF)", user);
#endif
}

}  // namespace pleat
