#include "engine/schedule.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "components/tethers.h"
#include "engine/layers.h"
#include "engine/room.h"
#include "engine/schedule_table.h"
#include "systems/frequency_bound.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/collision_bodies.h"
#include "systems/substep_bound.h"
#endif

namespace pleat {
namespace {

constexpr std::uint32_t kMostSubsteps = 64;
constexpr std::uint32_t kStiffSubsteps = 4;  // times as many as without stiff springs, at most

Plan plan_of(const World& world, const ClothRecord& cloth) {
  Plan plan = 0;
  const std::span<const Row> rows = schedule_table();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].left_out(world, cloth) == nullptr) plan |= Plan{1} << r;
  }
  return plan;
}

void run_phase(ClothTick& t, Phase phase) {
  const std::span<const Row> rows = schedule_table();
  const pleat_world_def& host = t.world.def;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].phase != phase || (t.cloth.plan >> r & 1) == 0) continue;
    if (host.stage != nullptr) host.stage(rows[r].name, 1, host.stage_user);
    rows[r].run(t);
    if (host.stage != nullptr) host.stage(rows[r].name, 0, host.stage_user);
  }
}

void copy(const Vec3View& to, const ConstVec3View& from, std::size_t count) {
  std::copy_n(from.x, count, to.x);
  std::copy_n(from.y, count, to.y);
  std::copy_n(from.z, count, to.z);
}

void run_substep(ClothTick& t) {
  const std::size_t n = t.garment.particle_count;
  run_phase(t, Phase::kSubstepBegin);
  copy(t.previous, t.position, n);
  const int stages = t.settings.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4 ? 4 : 1;
  for (t.stage = 0; t.stage < stages; ++t.stage) {
    std::fill_n(t.force.x, n, 0.0f);
    std::fill_n(t.force.y, n, 0.0f);
    std::fill_n(t.force.z, n, 0.0f);
    run_phase(t, Phase::kStage);
  }
  copy(t.predicted, t.position, n);
  t.world.contact_count = 0;
  run_phase(t, Phase::kContact);
  const std::uint32_t sweeps = t.settings.sweeps * (1 + t.garment.depth / kSweepReach);
  for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep) run_phase(t, Phase::kSweep);
  run_phase(t, Phase::kSubstepEnd);
}

/// As many substeps as keep the cloth's relative motion to capsules in each below half their radius.
std::uint32_t substeps_against_tunnelling([[maybe_unused]] const ClothTick& t, [[maybe_unused]] float dt) {
#ifdef PLEAT_WITH_COLLISION
  if (t.world.capsules.size() == 0 && t.world.meshes.empty()) return 1;
  const SubstepBound bound{.particle_count = t.garment.particle_count,
                           .position = t.position,
                           .velocity = t.velocity,
                           .capsules = &t.world.capsules,
                           .meshes = t.world.mesh_pointers.data(),
                           .mesh_count = static_cast<std::uint32_t>(t.world.mesh_pointers.size()),
                           .thickness = t.settings.thickness,
                           .dt = dt};
  assert(bound.validate());
  return bound.run();
#else
  return 1;
#endif
}

StableStep stable_step(const ClothTick& t) {
  const pleat_cloth_settings& s = t.settings;
  const bool solved = s.integrator == PLEAT_INTEGRATOR_PROJECTED || s.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER;
  const bool runge_kutta = s.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4;
  return {.rates = t.cloth.rates,
          .scheme = runge_kutta ? Scheme::kRungeKutta4 : Scheme::kEuler,
          .stiffness = solved ? 0.0f : s.stiffness,
          .bend_stiffness = s.bend_stiffness,
          .edge_damping = s.edge_damping,
          .bend_damping = s.bend_damping,
          .air_damping = s.air_damping};
}

void report_lowered(ClothTick& t, std::uint32_t substeps) {
  ++t.world.stats.stiffness_lowered;
  if (t.cloth.said_lowered) return;
  t.cloth.said_lowered = true;
  t.world.log(PLEAT_LOG_WARNING, "a cloth's stiffness " + std::to_string(t.settings.stiffness) +
                                     " N/m or bend_stiffness " + std::to_string(t.settings.bend_stiffness) +
                                     " N m is more than " + std::to_string(substeps) +
                                     " substeps a tick can carry: its stiffest edges act softer");
}

std::uint32_t substeps_for(ClothTick& t, float dt) {
  const std::uint32_t least = substeps_against_tunnelling(t, dt);
  const StableStep stable = stable_step(t);
  assert(stable.validate());
  std::uint32_t n = t.settings.substeps;
  if (n == 0) {
    const bool implicit = t.settings.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER;
    const float longest = (implicit ? 4.0f : 1.0f) * t.world.def.max_substep;
    // The small allowance keeps 1/60 s at 8 steps of 1/480 s despite rounding.
    const double wanted = std::ceil(static_cast<double>(dt) / static_cast<double>(longest) - 1e-3);
    n = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, static_cast<double>(kMostSubsteps)));
    n = std::clamp(least, n, kMostSubsteps);
    const std::uint32_t most = std::min(kStiffSubsteps * n, kMostSubsteps);
    n = std::min(stable.run(dt, n, most), most);
  }
  if (n < least) ++t.world.stats.fast_bodies;
  if (stable.run(dt, n, n) > n) report_lowered(t, n);
  const bool implicit = t.settings.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER;
  t.spring_room = implicit ? std::numeric_limits<float>::infinity() : stable.room(dt / static_cast<float>(n));
  return n;
}

void tick_cloth(World& world, ClothRecord& cloth, float dt) {
  ClothTick t(world, cloth);
  const Stats before = world.stats;
  const std::uint32_t n = substeps_for(t, dt);
  t.dt = dt / static_cast<float>(n);
  t.frame_dt = dt;
  world.contact_count = 0;
  for (std::uint32_t s = 0; s < n; ++s) {
    t.t0 = static_cast<float>(s) / static_cast<float>(n);
    t.t1 = static_cast<float>(s + 1) / static_cast<float>(n);
    t.time = world.time + static_cast<double>(dt) * s / n;
    run_substep(t);
  }
  run_phase(t, Phase::kFrameEnd);
  cloth.substeps_taken = n;
  cloth.contacts = {.particle = world.stats.particle_contacts - before.particle_contacts,
                    .face = world.stats.face_contacts - before.face_contacts,
                    .self = world.stats.self_contacts - before.self_contacts,
                    .dropped = world.stats.contacts_dropped - before.contacts_dropped};
  world.substeps += n;
}

/// What was next becomes previous: a pin or body that is not moved again stands still.
void settle_poses(World& world) {
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

/// Files the bodies of this tick in their trees.
void update_bodies([[maybe_unused]] World& world) {
#ifdef PLEAT_WITH_COLLISION
  if (world.bodies == nullptr) return;
  world.bodies->update_capsules(world.capsules);
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    MeshRecord& record = world.meshes[i];
    if (record.stale_ticks == 0) continue;
    world.bodies->update_mesh(i, record.mesh);
    --record.stale_ticks;
  }
#endif
}

const char* phase_name(Phase phase) {
  switch (phase) {
    case Phase::kSubstepBegin:
      return "substep begin";
    case Phase::kStage:
      return "stage";
    case Phase::kContact:
      return "contact";
    case Phase::kSweep:
      return "sweep";
    case Phase::kSubstepEnd:
      return "substep end";
    case Phase::kFrameEnd:
      return "frame end";
  }
  return "";
}

}  // namespace

ClothTick::ClothTick(World& w, ClothRecord& c)
    : world(w),
      cloth(c),
      garment(c.garment()),
      settings(c.settings),
      air{w.def.wind[0], w.def.wind[1], w.def.wind[2]},
      position(w.particles.position.view().from(c.particle_begin)),
      velocity(w.particles.velocity.view().from(c.particle_begin)),
      force(w.particles.force.view().from(c.particle_begin)),
      previous(w.particles.previous.view().from(c.particle_begin)),
      predicted(w.particles.predicted.view().from(c.particle_begin)),
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
  const FrequencyBound bound{.garment = &cloth.garment(),
                             .inverse_mass = world.particles.inverse_mass.data() + cloth.particle_begin};
  assert(bound.validate());
  cloth.rates = bound.run();
  cloth.said_lowered = false;
  cloth.plan = plan_of(world, cloth);
#ifdef PLEAT_WITH_COLLISION
  if (world.bodies != nullptr) world.bodies->update_capsules(world.capsules);
#endif
  ClothTick t(world, cloth);
  t.t1 = t.t0;  // between ticks bodies are where the last one left them
  run_phase(t, Phase::kFrameEnd);
}

void replan(World& world) {
  for (ClothRecord& cloth : world.clothes) {
    make_room(world, cloth);
    cloth.plan = plan_of(world, cloth);
  }
}

void tick(World& world, float dt) {
  ++world.ticks;
  world.stats.particle_contacts = world.stats.face_contacts = world.stats.self_contacts = 0;
  update_bodies(world);
  begin_layers(world);
  const std::uint32_t top = top_layer(world);
  for (std::uint32_t layer = 0; layer <= top; ++layer) {
    for (std::uint32_t i = 0; i < world.clothes.size(); ++i) {
      if (world.clothes[i].settings.layer != layer) continue;
      tick_cloth(world, world.clothes[i], dt);
      publish_layer(world, i);
    }
  }
  world.time += static_cast<double>(dt);
  settle_poses(world);
}

void explain(const World& world, pleat_text_fn write, void* user) {
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
