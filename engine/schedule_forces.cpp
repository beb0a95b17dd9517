// Rows from the begin of a tick to the integrated position: pins, forces, integration.
#include <algorithm>

#include "engine/schedule_row.h"
#include "engine/teleport.h"
#include "systems/air_damping.h"
#include "systems/air_drag.h"
#include "systems/edge_damping.h"
#include "systems/elastic_force.h"
#include "systems/gravity.h"
#include "systems/gust.h"
#include "systems/hinge_bending.h"
#include "systems/implicit_solver.h"
#include "systems/inner_friction.h"
#include "systems/integration.h"
#include "systems/pin_motion.h"
#include "systems/slow_force.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/contact_acceleration.h"
#endif

namespace pleat {
namespace {

/// Of backward Euler's damping, what hinges get from `projected`, whose edges are as good as implicit. Together with
/// the stiffest bending that StableStep lets through it is just what a step carries.
constexpr float kStepDamping = 0.5f;

bool projected(const pleat_cloth_settings& s) { return s.integrator == PLEAT_INTEGRATOR_PROJECTED; }
bool runge_kutta(const pleat_cloth_settings& s) { return s.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4; }
bool implicit(const pleat_cloth_settings& s) { return s.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER; }

const char* without_air(const World& w, const ClothRecord& c) {
  const bool slips = c.settings.drag_coefficient == 0.0f && c.settings.lift_coefficient == 0.0f;
  return slips                       ? "drag_coefficient and lift_coefficient are 0"
         : w.def.air_density == 0.0f ? "air_density is 0"
                                     : kNeeded;
}

const char* with_bending(const World&, const ClothRecord& c) {
  return c.garment().hinge_count == 0 ? "no two faces share an edge"
         : !resists_bending(c)        ? "bend_stiffness is 0"
                                      : kNeeded;
}

/// Whether the force of bending is to be found anew in this step, or has some of its time left.
bool bends_anew(ClothTick& t) {
  const float held = t.force_dt * static_cast<float>(t.bending_held - 1);  // s, beyond the present step
  float& left = t.cloth.bending_left;
  left = std::min(left, held);
  if (left > 0.5f * t.force_dt) {
    left -= t.force_dt;
    return false;
  }
  left = held;
  return true;
}

constexpr Row kRows[] = {
    {Phase::kFrameBegin, "teleport", always, teleport},
    {Phase::kSubstepBegin, "pin_motion",
     [](const World&, const ClothRecord& c) { return c.garment().pins.size() != 0 ? kNeeded : "no pins"; },
     [](ClothTick& t) {
       run(PinMotion{.garment = &t.garment,
                     .pin_previous = t.pin_previous,
                     .pin_next = t.pin_next,
                     .t0 = t.t0,
                     .t1 = t.t1,
                     .dt = t.dt,
                     .position = t.position,
                     .velocity = t.velocity});
     }},

    {Phase::kStage, "elastic_force",
     [](const World&, const ClothRecord& c) {
       return c.settings.stiffness == 0.0f                          ? "stiffness is 0"
              : c.settings.integrator == PLEAT_INTEGRATOR_PROJECTED ? "edges are projected"
                                                                    : kNeeded;
     },
     [](ClothTick& t) {
       run(ElasticForce{.garment = &t.garment,
                        .position = t.position,
                        .inverse_mass = t.inverse_mass,
                        .law = t.edge_law(),
                        .room = t.spring_room,
                        .force = t.force});
     }},
    {Phase::kStage, "hinge_bending", with_bending,
     [](ClothTick& t) {
       if (!bends_anew(t)) return;
       const Vec3View bending = t.world.bending.view().from(t.cloth.particle_begin);
       clear(bending, t.garment.particle_count);
       run(HingeBending{.garment = &t.garment,
                        .position = t.position,
                        .velocity = t.velocity,
                        .inverse_mass = t.inverse_mass,
                        .stiffness = t.settings.bend_stiffness,
                        .damping_rate = t.settings.bend_damping,
                        .dt = t.force_dt * static_cast<float>(t.bending_held),
                        .packed = &t.worker.packed,
                        .scratch = &t.worker.hinge_scratch,
                        .force = bending,
                        .step_damping = projected(t.settings) ? kStepDamping : 0.0f});
     }},
    {Phase::kStage, "slow_force", with_bending,
     [](ClothTick& t) {
       run(SlowForce{.particle_count = t.garment.particle_count,
                     .slow = t.world.bending.view().from(t.cloth.particle_begin),
                     .force = t.force});
     }},
    {Phase::kStage, "edge_damping",
     [](const World& w, const ClothRecord& c) {
       return c.settings.edge_damping == 0.0f    ? "edge_damping is 0"
              : with_projection(w, c) == kNeeded ? "edges are projected"
                                                 : kNeeded;
     },
     [](ClothTick& t) {
       run(EdgeDamping{.garment = &t.garment,
                       .position = t.position,
                       .velocity = t.velocity,
                       .inverse_mass = t.inverse_mass,
                       .rate = t.settings.edge_damping,
                       .dt = t.force_dt,
                       .packed = &t.worker.packed,
                       .force = t.force});
     }},
    {Phase::kStage, "gravity",
     [](const World& w, const ClothRecord&) {
       const float* g = w.def.gravity;
       return g[0] != 0.0f || g[1] != 0.0f || g[2] != 0.0f ? kNeeded : "gravity is 0";
     },
     [](ClothTick& t) {
       const float* g = t.world.def.gravity;
       run(Gravity{.particle_count = t.garment.particle_count,
                   .mass = t.mass,
                   .acceleration = {g[0], g[1], g[2]},
                   .force = t.force});
     }},
    {Phase::kStage, "air_damping",
     [](const World&, const ClothRecord& c) { return c.settings.air_damping > 0.0f ? kNeeded : "air_damping is 0"; },
     [](ClothTick& t) {
       run(AirDamping{.particle_count = t.garment.particle_count,
                      .mass = t.mass,
                      .velocity = t.velocity,
                      .rate = t.settings.air_damping,
                      .dt = t.force_dt,
                      .force = t.force});
     }},
    {Phase::kStage, "inner_friction",
     [](const World&, const ClothRecord& c) {
       return c.settings.inner_friction > 0.0f ? kNeeded : "inner_friction is 0";
     },
     [](ClothTick& t) {
       run(InnerFriction{.garment = &t.garment,
                         .mass = t.mass,
                         .velocity = t.velocity,
                         .deceleration = t.settings.inner_friction,
                         .dt = t.force_dt,
                         .elapsed = runge_kutta(t.settings) ? 0.25f * t.force_dt : t.force_dt,
                         .held = t.world.held.view().from(t.cloth.particle_begin),
                         .force = t.force});
     }},
    {Phase::kStage, "gust",
     [](const World& w, const ClothRecord& c) {
       const char* why = without_air(w, c);
       return why != nullptr ? why : w.def.gust == 0.0f ? "gust is 0" : kNeeded;
     },
     [](ClothTick& t) {
       const pleat_world_def& d = t.world.def;
       run(Gust{.wind = {d.wind[0], d.wind[1], d.wind[2]},
                .strength = d.gust,
                .frequency = d.gust_frequency,
                .seed = d.gust_seed,
                .time = t.time,
                .air = &t.air});
     }},
    {Phase::kStage, "air_drag", without_air,
     [](ClothTick& t) {
       run(AirDrag{.garment = &t.garment,
                   .position = t.position,
                   .velocity = t.velocity,
                   .wind = t.air,
                   .air_density = t.world.def.air_density,
                   .drag_coefficient = t.settings.drag_coefficient,
                   .lift_coefficient = t.settings.lift_coefficient,
                   .density = t.settings.density,
                   .dt = t.force_dt,
                   .force = t.force});
     }},
#ifdef PLEAT_WITH_COLLISION
    {Phase::kStage, "contact_acceleration", with_others,
     [](ClothTick& t) {
       run(ContactAcceleration{.contacts = contacts_of(t),
                               .position = t.position,
                               .velocity = t.velocity,
                               .inverse_mass = t.inverse_mass,
                               .dt = t.force_dt,
                               .row_dt = t.dt,
                               .force = t.force});
     }},
#endif
    {Phase::kStage, "euler_integration",
     [](const World&, const ClothRecord& c) {
       return runge_kutta(c.settings) || implicit(c.settings) ? "another integrator" : kNeeded;
     },
     [](ClothTick& t) {
       run(EulerIntegration{.particle_count = t.garment.particle_count,
                            .inverse_mass = t.inverse_mass,
                            .force = t.force,
                            .dt = t.force_dt,
                            .symplectic = t.settings.integrator != PLEAT_INTEGRATOR_EXPLICIT_EULER,
                            .position = t.position,
                            .velocity = t.velocity});
     }},
    {Phase::kStage, "runge_kutta_integration",
     [](const World&, const ClothRecord& c) { return runge_kutta(c.settings) ? kNeeded : "another integrator"; },
     [](ClothTick& t) {
       RungeKuttaColumns& slopes = t.world.runge_kutta;
       run(RungeKuttaIntegration{.particle_count = t.garment.particle_count,
                                 .inverse_mass = t.inverse_mass,
                                 .force = t.force,
                                 .start_position = t.previous,
                                 .dt = t.force_dt,
                                 .stage = t.stage,
                                 .position = t.position,
                                 .velocity = t.velocity,
                                 .start_velocity = slopes.start_velocity.view().from(t.cloth.particle_begin),
                                 .position_slope = slopes.position_slope.view().from(t.cloth.particle_begin),
                                 .velocity_slope = slopes.velocity_slope.view().from(t.cloth.particle_begin)});
     }},
    {Phase::kStage, "implicit_integration",
     [](const World&, const ClothRecord& c) { return implicit(c.settings) ? kNeeded : "another integrator"; },
     [](ClothTick& t) {
       run(ImplicitIntegration{.garment = &t.garment,
                               .matrix = t.cloth.source->implicit[t.worker.number].get(),
                               .inverse_mass = t.inverse_mass,
                               .force = t.force,
                               .law = t.edge_law(),
                               .dt = t.force_dt,
                               .position = t.position,
                               .velocity = t.velocity});
     }},
};

}  // namespace

std::span<const Row> force_rows() { return kRows; }

}  // namespace pleat
