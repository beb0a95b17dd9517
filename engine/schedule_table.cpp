#include "engine/schedule_table.h"

#include <cassert>

#include "systems/air_damping.h"
#include "systems/air_drag.h"
#include "systems/edge_damping.h"
#include "systems/elastic_force.h"
#include "systems/finite_guard.h"
#include "systems/gravity.h"
#include "systems/hinge_bending.h"
#include "systems/integration.h"
#include "systems/pin_motion.h"
#include "systems/stretch_constraint.h"
#include "systems/velocity_update.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/capsule_detection.h"
#include "systems/collider_motion.h"
#include "systems/collision_bodies.h"
#include "systems/collision_response.h"
#include "systems/contact_acceleration.h"
#include "systems/contact_friction.h"
#include "systems/contact_row.h"
#include "systems/mesh_detection.h"
#endif
#ifdef PLEAT_WITH_SMOOTHING
#include "systems/drawn_normals.h"
#include "systems/edge_length.h"
#include "systems/particle_normals.h"
#include "systems/tessellation.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/surface_clearance.h"
#endif
#endif

namespace pleat {
namespace {

using Settings = pleat_cloth_settings;

template <class System, class... Counters>
void run(const System& system, Counters&... counters) {
  assert(system.validate());
  system.run(counters...);
}

constexpr const char* kNeeded = nullptr;
const char* always(const World&, const ClothRecord&) { return kNeeded; }

bool runge_kutta(const Settings& s) { return s.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4; }

#ifdef PLEAT_WITH_COLLISION
const char* with_colliders(const World& w, const ClothRecord&) { return w.colliders.empty() ? "no collider" : kNeeded; }
const char* with_capsules(const World& w, const ClothRecord&) {
  return w.colliders.empty() ? "no collider" : w.capsules.size() == 0 ? "no capsule" : kNeeded;
}
const char* with_meshes(const World& w, const ClothRecord&) {
  return w.colliders.empty() ? "no collider" : w.meshes.empty() ? "no mesh body" : kNeeded;
}

ContactList contacts_of(ClothTick& t) {
  World& w = t.world;
  return {w.contacts.data(), static_cast<std::uint32_t>(w.contacts.size()), &w.contact_count};
}

void respond(ClothTick& t) {
  run(CollisionResponse{.contacts = contacts_of(t),
                        .inverse_mass = t.inverse_mass,
                        .face_response = static_cast<FaceResponse>(t.settings.face_response),
                        .position = t.position},
      t.world.stats);
}
#endif

#ifdef PLEAT_WITH_SMOOTHING
SurfaceMode surface_mode(const Settings& s) { return static_cast<SurfaceMode>(s.surface); }

const char* with_normals(const World&, const ClothRecord& c) {
  return c.settings.surface == PLEAT_SURFACE_FLAT ? "flat surface" : kNeeded;
}
const char* with_folds(const World&, const ClothRecord& c) {
  return c.settings.surface == PLEAT_SURFACE_FLAT ? "flat surface"
         : has_folds(surface_mode(c.settings))    ? kNeeded
                                                  : "surface without folds, edges keep their curve";
}
#endif

constexpr Row kRows[] = {
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
     [](const World&, const ClothRecord& c) { return c.settings.stiffness > 0.0f ? kNeeded : "stiffness is 0"; },
     [](ClothTick& t) {
       run(ElasticForce{.garment = &t.garment,
                        .position = t.position,
                        .inverse_mass = t.inverse_mass,
                        .stiffness = t.settings.stiffness,
                        .dt = t.dt,
                        .force = t.force});
     }},
    {Phase::kStage, "hinge_bending",
     [](const World&, const ClothRecord& c) {
       return c.garment().hinge_count == 0                                           ? "no two faces share an edge"
              : c.settings.bend_stiffness == 0.0f && c.settings.bend_damping == 0.0f ? "bend_stiffness is 0"
                                                                                     : kNeeded;
     },
     [](ClothTick& t) {
       run(HingeBending{.garment = &t.garment,
                        .position = t.position,
                        .velocity = t.velocity,
                        .inverse_mass = t.inverse_mass,
                        .stiffness = t.settings.bend_stiffness,
                        .damping_rate = t.settings.bend_damping,
                        .dt = t.dt,
                        .force = t.force});
     }},
    {Phase::kStage, "edge_damping",
     [](const World&, const ClothRecord& c) { return c.settings.edge_damping > 0.0f ? kNeeded : "edge_damping is 0"; },
     [](ClothTick& t) {
       run(EdgeDamping{.garment = &t.garment,
                       .position = t.position,
                       .velocity = t.velocity,
                       .inverse_mass = t.inverse_mass,
                       .rate = t.settings.edge_damping,
                       .dt = t.dt,
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
                      .dt = t.dt,
                      .force = t.force});
     }},
    {Phase::kStage, "air_drag",
     [](const World& w, const ClothRecord& c) {
       return c.settings.drag_coefficient == 0.0f ? "drag_coefficient is 0"
              : w.def.air_density == 0.0f         ? "air_density is 0"
                                                  : kNeeded;
     },
     [](ClothTick& t) {
       const float* wind = t.world.def.wind;
       run(AirDrag{.garment = &t.garment,
                   .position = t.position,
                   .velocity = t.velocity,
                   .wind = {wind[0], wind[1], wind[2]},
                   .air_density = t.world.def.air_density,
                   .drag_coefficient = t.settings.drag_coefficient,
                   .density = t.settings.density,
                   .dt = t.dt,
                   .force = t.force});
     }},
#ifdef PLEAT_WITH_COLLISION
    {Phase::kStage, "contact_acceleration", with_colliders,
     [](ClothTick& t) {
       run(ContactAcceleration{.contacts = contacts_of(t),
                               .position = t.position,
                               .velocity = t.velocity,
                               .inverse_mass = t.inverse_mass,
                               .dt = t.dt,
                               .force = t.force});
     }},
#endif
    {Phase::kStage, "euler_integration",
     [](const World&, const ClothRecord& c) { return runge_kutta(c.settings) ? "integrates by Runge-Kutta" : kNeeded; },
     [](ClothTick& t) {
       run(EulerIntegration{.particle_count = t.garment.particle_count,
                            .inverse_mass = t.inverse_mass,
                            .force = t.force,
                            .dt = t.dt,
                            .symplectic = t.settings.integrator == PLEAT_INTEGRATOR_SYMPLECTIC_EULER,
                            .position = t.position,
                            .velocity = t.velocity});
     }},
    {Phase::kStage, "runge_kutta_integration",
     [](const World&, const ClothRecord& c) { return runge_kutta(c.settings) ? kNeeded : "integrates by Euler"; },
     [](ClothTick& t) {
       RungeKuttaColumns& slopes = t.world.runge_kutta;
       run(RungeKuttaIntegration{.particle_count = t.garment.particle_count,
                                 .inverse_mass = t.inverse_mass,
                                 .force = t.force,
                                 .start_position = t.previous,
                                 .dt = t.dt,
                                 .stage = t.stage,
                                 .position = t.position,
                                 .velocity = t.velocity,
                                 .start_velocity = slopes.start_velocity.view().from(t.cloth.particle_begin),
                                 .position_slope = slopes.position_slope.view().from(t.cloth.particle_begin),
                                 .velocity_slope = slopes.velocity_slope.view().from(t.cloth.particle_begin)});
     }},

#ifdef PLEAT_WITH_COLLISION
    {Phase::kContact, "collider_motion", with_capsules,
     [](ClothTick& t) {
       World& w = t.world;
       run(ColliderMotion{.capsules = &w.capsules,
                          .bodies = w.bodies.get(),
                          .particle_count = t.garment.particle_count,
                          .position = t.position,
                          .reach =
                              t.settings.thickness + contact_margin(t.position, t.previous, t.garment.particle_count),
                          .t0 = t.t0,
                          .t1 = t.t1,
                          .poses = w.capsule_poses.data(),
                          .capacity = static_cast<std::uint32_t>(w.capsule_poses.size()),
                          .pose_count = &w.capsule_pose_count},
           w.stats);
     }},
    {Phase::kContact, "capsule_detection", with_capsules,
     [](ClothTick& t) {
       World& w = t.world;
       run(CapsuleDetection{.garment = &t.garment,
                            .position = t.position,
                            .previous = t.previous,
                            .inverse_mass = t.inverse_mass,
                            .capsules = w.capsule_poses.data(),
                            .capsule_count = w.capsule_pose_count,
                            .thickness = t.settings.thickness,
                            .friction = t.settings.friction,
                            .dt = t.dt,
                            .scratch = w.detection_scratch.data(),
                            .contacts = contacts_of(t)},
           w.stats);
     }},
    {Phase::kContact, "mesh_detection", with_meshes,
     [](ClothTick& t) {
       World& w = t.world;
       run(MeshDetection{.garment = &t.garment,
                         .position = t.position,
                         .previous = t.previous,
                         .inverse_mass = t.inverse_mass,
                         .bodies = w.bodies.get(),
                         .meshes = w.mesh_pointers.data(),
                         .t0 = t.t0,
                         .t1 = t.t1,
                         .thickness = t.settings.thickness,
                         .friction = t.settings.friction,
                         .dt = t.dt,
                         .contacts = contacts_of(t)},
           w.stats);
     }},
#endif

    {Phase::kSweep, "stretch_constraint",
     [](const World&, const ClothRecord& c) {
       return c.settings.stretch_limit < 1.0f ? kNeeded : "stretch_limit is 1 or more";
     },
     [](ClothTick& t) {
       run(StretchConstraint{.garment = &t.garment,
                             .inverse_mass = t.inverse_mass,
                             .limit = t.settings.stretch_limit,
                             .position = t.position},
           t.world.stats);
     }},

#ifdef PLEAT_WITH_COLLISION
    {Phase::kSweep, "collision_response", with_colliders, respond},
    {Phase::kSubstepEnd, "contact_friction", with_colliders,
     [](ClothTick& t) {
       run(ContactFriction{
           .contacts = contacts_of(t), .previous = t.previous, .inverse_mass = t.inverse_mass, .position = t.position});
     }},
    {Phase::kSubstepEnd, "collision_last_word", with_colliders, respond},
#endif

    {Phase::kSubstepEnd, "velocity_update", always,
     [](ClothTick& t) {
       run(VelocityUpdate{.particle_count = t.garment.particle_count,
                          .position = t.position,
                          .predicted = t.predicted,
                          .inverse_mass = t.inverse_mass,
                          .dt = t.dt,
                          .velocity = t.velocity});
     }},
#ifdef PLEAT_WITH_COLLISION
    {Phase::kSubstepEnd, "contact_velocity", with_colliders,
     [](ClothTick& t) {
       run(ContactVelocity{
           .contacts = contacts_of(t), .inverse_mass = t.inverse_mass, .dt = t.dt, .velocity = t.velocity});
     }},
#endif
    {Phase::kSubstepEnd, "finite_guard", always,
     [](ClothTick& t) {
       run(FiniteGuard{.particle_count = t.garment.particle_count,
                       .previous = t.previous,
                       .position = t.position,
                       .velocity = t.velocity},
           t.world.stats);
     }},

#ifdef PLEAT_WITH_SMOOTHING
    {Phase::kFrameEnd, "particle_normals", with_normals,
     [](ClothTick& t) {
       run(ParticleNormals{.mode = surface_mode(t.settings),
                           .garment = &t.garment,
                           .position = t.position,
                           .normal = t.normal,
                           .fold = t.fold});
     }},
    {Phase::kFrameEnd, "edge_length", with_folds,
     [](ClothTick& t) {
       run(EdgeLength{.mode = surface_mode(t.settings),
                      .garment = &t.garment,
                      .position = t.position,
                      .normal = t.normal,
                      .fold = t.fold,
                      .fold_height = t.fold_height});
     }},
    {Phase::kFrameEnd, "tessellation", always,
     [](ClothTick& t) {
       run(Tessellation{.mode = surface_mode(t.settings),
                        .garment = &t.garment,
                        .pattern = t.cloth.pattern(),
                        .position = t.position,
                        .normal = t.normal,
                        .fold = t.fold,
                        .fold_height = t.fold_height,
                        .drawn_position = t.drawn_position});
     }},
#ifdef PLEAT_WITH_COLLISION
    {Phase::kFrameEnd, "surface_footprint", with_capsules,
     [](ClothTick& t) {
       run(Tessellation{.mode = SurfaceMode::kFlat,
                        .garment = &t.garment,
                        .pattern = t.cloth.pattern(),
                        .position = t.position,
                        .normal = {},
                        .fold = {},
                        .drawn_position = t.world.footprint.view()});
     }},
    {Phase::kFrameEnd, "surface_capsules", with_capsules,
     [](ClothTick& t) {
       World& w = t.world;
       run(ColliderMotion{.capsules = &w.capsules,
                          .bodies = w.bodies.get(),
                          .particle_count = t.garment.particle_count,
                          .position = t.position,
                          .reach = t.garment.mean_edge_length,  // the surface bulges less than that
                          .t0 = t.t0,
                          .t1 = t.t1,
                          .poses = w.capsule_poses.data(),
                          .capacity = static_cast<std::uint32_t>(w.capsule_poses.size()),
                          .pose_count = &w.capsule_pose_count},
           w.stats);
     }},
    {Phase::kFrameEnd, "surface_clearance", with_capsules,
     [](ClothTick& t) {
       World& w = t.world;
       run(SurfaceClearance{.garment = &t.garment,
                            .pattern = t.cloth.pattern(),
                            .footprint = w.footprint.view(),
                            .capsules = w.capsule_poses.data(),
                            .capsule_count = w.capsule_pose_count,
                            .clearance = 0.5f * t.settings.thickness,  // the rest is left to contact that is not exact
                            .planes = w.clearance_planes.data(),
                            .plane_capacity = static_cast<std::uint32_t>(w.clearance_planes.size()),
                            .drawn_position = t.drawn_position});
     }},
#endif
    {Phase::kFrameEnd, "drawn_normals", always,
     [](ClothTick& t) {
       run(DrawnNormals{.pattern = t.cloth.pattern(), .position = t.drawn_position, .normal = t.drawn_normal});
     }},
#endif
};

static_assert(std::size(kRows) <= 64, "a Plan has a bit for each row");

}  // namespace

std::span<const Row> schedule_table() { return kRows; }

}  // namespace pleat
