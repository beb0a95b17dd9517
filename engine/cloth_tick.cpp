#include "engine/cloth_tick.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "components/lanes.h"
#include "components/tethers.h"
#include "components/wide.h"
#include "engine/budget.h"
#include "engine/run.h"
#include "engine/sleep.h"
#include "engine/turns.h"
#include "systems/frequency_bound.h"
#include "systems/largest_stretch.h"
#include "systems/rigid_fit.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/contact_row.h"
#endif

namespace pleat {
namespace {

constexpr std::uint32_t kStiffSubsteps = 4;         // times as many as without stiff springs, at most
constexpr std::uint32_t kMostForceSteps = 4;        // of a substep, where nothing but bending is stiff
constexpr float kBendingHeld = 1.0f / 120;          // s, for how long its force is held where it is soft, at most
constexpr float kLooseStart = 0.005f;               // elongation beyond the strain limit that a start may have
constexpr float kReach = 0.5f, kRoughReach = 1.0f;  // of bodies in a substep: systems/substep_bound.h
constexpr int kRetries = 2;  // of a tick that went wrong, each with twice the substeps, 128 at most

/// A start that is stretched or inside a body, as garments made for another body are, is pulled together and pushed out
/// before it may move: the strain limit and the contacts would turn that into speed.
void begin_settling(ClothTick& t) {
  t.loose = t.settings.stretch_limit < 1.0f &&
            run(LargestStretch{.garment = &t.garment, .position = t.position, .inverse_mass = t.inverse_mass}) >
                t.settings.stretch_limit + kLooseStart;
  t.cloth.settling = std::max(t.cloth.settling - t.frame_dt, 0.0f);
}

/// After each of its substeps.
void settle([[maybe_unused]] ClothTick& t) {
#ifdef PLEAT_WITH_COLLISION
  const ContactRow* rows = t.worker.contacts.data();
  t.deep = std::any_of(rows + t.cloth_rows, rows + t.worker.contact_count,
                       [&](const ContactRow& row) { return comes_from_inside(row, t.previous, t.dt); });
#endif
  if (t.loose || t.deep) clear(t.velocity, t.garment.particle_count);
}

std::uint32_t quotient_up(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

/// Passes of strain limit and contact in each substep: as many more for each kSweepReach of the depth or, where coarse
/// levels carry pulls, for each doubling of it. What carries them is all passes of a tick: where there are more
/// substeps than the cloth's motion wants, because it is stiff, each needs fewer; where there are not as many, because
/// detail is given up, half of the passes that are missing are made up for.
std::uint32_t sweeps_for(const ClothTick& t) {
  const std::uint32_t reaches = t.garment.depth / kSweepReach;
  const bool has_levels = !t.garment.coarse.empty();
  const std::uint32_t more = has_levels ? static_cast<std::uint32_t>(std::bit_width(reaches)) : reaches;
  const std::uint32_t deep = t.settings.sweeps * (1 + more);
  const std::uint32_t missing = t.cloth.substeps_wanted - std::min(t.cloth.substeps_wanted, t.substeps);
  const std::uint32_t wanted = t.cloth.substeps_wanted - missing / 2;  // substeps with as many passes as is usual
  const std::uint32_t least = has_levels ? kExactSweeps + 1 : 1;       // one goes over the coarse levels
  return std::max({t.settings.sweeps, least, quotient_up(deep * wanted, t.substeps)});
}

void run_substep(ClothTick& t) {
  const std::size_t n = t.garment.particle_count;
  run_phase(t, Phase::kSubstepBegin);
  copy(t.previous, t.position, n);
  const int stages = t.settings.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4 ? 4 : 1;
  for (std::uint32_t step = 0; step < t.force_steps; ++step) {
    for (t.stage = 0; t.stage < stages; ++t.stage) {
      clear(t.force, n);
      run_phase(t, Phase::kStage);
    }
  }
  copy(t.predicted, t.position, n);
  t.worker.contact_count = t.cloth_rows = 0;
  // What goes over edges and rows again and again finds a particle's numbers beside each other.
  Vec4* packed = t.worker.packed.position.data();
  run_wide(widest_vectors(), [&] {
    pack(t.previous, nullptr, n, t.worker.packed.previous.data());
    pack(t.position, t.inverse_mass, n, packed);
  });
  run_phase(t, Phase::kContact);
  for (t.sweeps_left = sweeps_for(t); t.sweeps_left != 0; --t.sweeps_left) run_phase(t, Phase::kSweep);
  run_phase(t, Phase::kFriction);
  run_wide(widest_vectors(), [&] { unpack(packed, n, t.position); });
  run_phase(t, Phase::kSubstepEnd);
  if (t.cloth.settling > 0.0f) settle(t);
}

StableStep stable_step(const ClothTick& t) {
  const pleat_cloth_settings& s = t.settings;
  const bool solved = s.integrator == PLEAT_INTEGRATOR_PROJECTED || s.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER;
  const bool runge_kutta = s.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4;
  const bool damped = s.integrator == PLEAT_INTEGRATOR_PROJECTED && s.stiffness > 0.0f;  // edges, where they are solved
  return {.rates = t.cloth.rates,
          .scheme = runge_kutta ? Scheme::kRungeKutta4 : Scheme::kEuler,
          .stiffness = solved ? 0.0f : s.stiffness,
          .bend_stiffness = s.bend_stiffness,
          .edge_damping = damped ? 0.0f : s.edge_damping,
          .bend_damping = s.bend_damping,
          .air_damping = s.air_damping};
}

void note(Notice& notice) {
  if (notice == Notice::kNothing) notice = Notice::kDue;
}

std::uint32_t substeps_for(ClothTick& t, float dt) {
  const bool rough = has_substeps_to_give(t.cloth) && steps_given_up(t.cloth) >= kRoughContact;
  const float travel = travel_of_bodies(t, rough ? kRoughReach : kReach);
  const auto least = static_cast<std::uint32_t>(std::ceil(std::max(travel, 1.0f)));
  const StableStep stable = stable_step(t);
  assert(stable.validate());
  const bool projected = t.settings.integrator == PLEAT_INTEGRATOR_PROJECTED;
  // Cloth without pins lies on something, and contact wants the substeps too.
  const bool only_bends = projected && t.garment.pins.size() != 0;
  const std::uint32_t pieces = only_bends ? kMostForceSteps : 1;  // that a substep may be cut into
  std::uint32_t n = t.cloth.substeps_wanted = t.settings.substeps;
  if (n == 0) {
    const bool implicit = t.settings.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER;
    const float longest = (implicit ? 3.0f : 1.0f) * t.world.def.max_substep;
    // The small allowance keeps 1/60 s at 6 steps of 1/360 s despite rounding.
    const double wanted = std::ceil(static_cast<double>(dt) / static_cast<double>(longest) - 1e-3);
    n = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, static_cast<double>(kMostSubsteps)));
    t.cloth.substeps_wanted = n;
    const std::uint32_t most = std::min(kStiffSubsteps * std::max(n, least), kMostSubsteps);
    n = static_cast<std::uint32_t>(std::ceil(static_cast<float>(n) * t.cloth.substep_share));
    n = std::clamp(least, n, kMostSubsteps);
    n = std::max(n, std::min(quotient_up(stable.run(dt, n, pieces * most), pieces), most));
  }
  if (n < least) ++t.worker.stats.fast_bodies;
  const std::uint32_t force_steps = stable.run(dt, n, pieces * n);
  t.force_steps = std::min(quotient_up(force_steps, n), pieces);
  if (force_steps > pieces * n) {
    ++t.worker.stats.stiffness_lowered;
    t.cloth.lowered_at = n;
    note(t.cloth.lowered);
  }
  return n;
}

/// For how many substeps a force of bending acts: one that is held for so long must be as stable as in one step.
std::uint32_t substeps_that_bend_alike(const ClothTick& t) {
  if (t.settings.integrator != PLEAT_INTEGRATOR_PROJECTED || t.force_steps > 1) return 1;
  const StableStep stable = stable_step(t);
  std::uint32_t n = 1;
  for (; n < kMostSubsteps && t.dt * static_cast<float>(n + 1) <= 1.001f * kBendingHeld; ++n) {
    if (stable.run(t.dt * static_cast<float>(n + 1), 1, 1) != 1) break;
  }
  return n;
}

void run_substeps(ClothTick& t, std::uint32_t n) {
  const float dt = t.frame_dt;
  t.substeps = n;
  t.dt = dt / static_cast<float>(n);
  t.force_dt = t.dt / static_cast<float>(t.force_steps);
  const bool implicit = t.settings.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER;
  t.bending_held = substeps_that_bend_alike(t);
  t.spring_room = implicit ? std::numeric_limits<float>::infinity() : stable_step(t).room(t.dt);
  t.trouble = false;
  t.worker.contact_count = 0;
  for (std::uint32_t s = 0; s < n && !t.trouble; ++s) {
    t.t0 = static_cast<float>(s) / static_cast<float>(n);
    t.t1 = static_cast<float>(s + 1) / static_cast<float>(n);
    t.time = t.world.time + static_cast<double>(dt) * s / n;
    run_substep(t);
  }
  run_phase(t, Phase::kCheck);
}

void roll_back(ClothTick& t) {
  const std::size_t n = t.garment.particle_count;
  copy(t.position, t.start, n);
  copy(t.velocity, t.start_velocity, n);
  forget_motion(t.world, t.cloth);
}

/// The cloth as it was when the tick began, at rest, carried to where its pins are at the tick's end.
void fall_back(ClothTick& t) {
  roll_back(t);
  t.t0 = t.t1 = 1.0f;
  clear(t.velocity, t.garment.particle_count);
  if (const std::size_t pins = t.garment.pins.size(); pins != 0) {
    t.carry = best_motion(t.pin_previous, t.pin_next, pins);
    carry_with_pins(t);
  }
  ++t.worker.stats.fallbacks;
  note(t.cloth.fallback);
}

}  // namespace

void run_phase(ClothTick& t, Phase phase) {
  const std::span<const Row> rows = schedule_table();
  const pleat_world_def& host = t.world.def;
  // Bit by bit: a row that is not in the plan is not even looked at.
  for (Plan left = t.cloth.plan & rows_of(phase); left != 0; left &= left - 1) {
    const Row& row = rows[static_cast<std::size_t>(std::countr_zero(left))];
    if (host.stage != nullptr) host.stage(row.name, 1, host.stage_user);
    row.run(t);
    if (host.stage != nullptr) host.stage(row.name, 0, host.stage_user);
  }
}

void tick_cloth(World& world, Worker& worker, ClothRecord& cloth, float dt) {
  ClothTick t(world, worker, cloth);
  t.frame_dt = dt;
  fade_substeps(cloth, dt);
  if (sleeps_on(t)) {
    ++worker.stats.sleeping;
    cloth.substeps_taken = 0;
    cloth.contacts = {};
    if (shows_fading(cloth)) {
      fade_folds(world, cloth, dt);
      run_phase(t, Phase::kFrameEnd);
    }
    return;
  }
  if (waits(t)) {
    stir(t);
    return run_phase(t, Phase::kCarried);
  }
  if (cloth.settling > 0.0f) begin_settling(t);
  fade_folds(world, cloth, dt);
  std::uint32_t n = substeps_for(t, dt);
  copy(t.start, t.position, t.garment.particle_count);
  copy(t.start_velocity, t.velocity, t.garment.particle_count);
  const Stats before = worker.stats;
  run_substeps(t, n);
  if (t.trouble) {
    for (int retry = 0; t.trouble && retry < kRetries && n <= kMostSubsteps; ++retry) {
      worker.stats = before;
      roll_back(t);
      run_substeps(t, n *= 2);
    }
    if (t.trouble) {
      worker.stats = before;
      fall_back(t);
    }
    ++worker.stats.rollbacks;
  }
  if (!t.loose && !t.deep) cloth.settling = 0.0f;
  run_phase(t, Phase::kFrameEnd);
  cloth.substeps_taken = n;
  cloth.contacts = {.particle = worker.stats.particle_contacts - before.particle_contacts,
                    .face = worker.stats.face_contacts - before.face_contacts,
                    .self = worker.stats.self_contacts - before.self_contacts,
                    .dropped = worker.stats.contacts_dropped - before.contacts_dropped};
  worker.substeps += n;
}

void report_troubles(const World& world, ClothRecord& cloth) {
  if (cloth.lowered == Notice::kDue) {
    cloth.lowered = Notice::kSaid;
    world.log(PLEAT_LOG_WARNING, "a cloth's stiffness " + std::to_string(cloth.settings.stiffness) +
                                     " N/m or bend_stiffness " + std::to_string(cloth.settings.bend_stiffness) +
                                     " N m is more than " + std::to_string(cloth.lowered_at) +
                                     " substeps a tick can carry: its stiffest edges act softer");
  }
  if (cloth.fallback == Notice::kDue) {
    cloth.fallback = Notice::kSaid;
    world.log(PLEAT_LOG_WARNING,
              "a cloth broke in a tick and in its repetitions with more substeps: it stays as it was");
  }
}

}  // namespace pleat
