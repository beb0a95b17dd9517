// Rows from the predicted position to the end of a substep: contact, strain limit, velocities, the guard.
#include "components/tethers.h"
#include "engine/schedule_row.h"
#include "engine/sleep.h"
#include "systems/coarse_stretch.h"
#include "systems/edge_ways.h"
#include "systems/elastic_projection.h"
#include "systems/energy_check.h"
#include "systems/finite_guard.h"
#include "systems/rounding_hold.h"
#include "systems/stretch_constraint.h"
#include "systems/tether_constraint.h"
#include "systems/velocity_update.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/capsule_candidates.h"
#include "systems/capsule_detection.h"
#include "systems/collision_bodies.h"
#include "systems/collision_response.h"
#include "systems/contact_friction.h"
#include "systems/contact_row.h"
#include "systems/layer_candidates.h"
#include "systems/layer_detection.h"
#include "systems/mesh_candidates.h"
#include "systems/mesh_detection.h"
#include "systems/plane_detection.h"
#include "systems/self_candidates.h"
#include "systems/self_detection.h"
#endif

namespace pleat {
namespace {

constexpr float kOverRelaxation = 1.6f;  // with 1.8 drapes at rest tremble more
#ifdef PLEAT_WITH_COLLISION
constexpr float kCreepSpeed = 0.02f;  // m/s, of cloth that friction holds while the strain limit pulls at it
#endif

/// The limit only pulls. The more passes it makes over cloth that hangs, the more of them give edges their length back;
/// three where a garment is 8 edges deep make cloth tremble that is too tight for the body, and two cloth that lies.
std::uint32_t elastic_passes(const ClothTick& t) {
  const bool hangs = t.garment.pins.size() != 0 && t.settings.stretch_limit < 1.0f;
  if (!hangs || t.garment.depth < kSweepReach) return 1;
  return t.garment.coarse.empty() ? 2 : 3;
}

/// In deep cloth all passes but a substep's last ones pull too far, so that fewer are needed; those put that right.
float relaxation_of(const ClothTick& t) {
  return t.garment.depth >= kCoarseDepth && t.sweeps_left > kExactSweeps ? kOverRelaxation : 1.0f;
}

void limit_stretch(ClothTick& t) {
  run(StretchConstraint{.slots = &t.garment.slots,
                        .limit = t.settings.stretch_limit,
                        .relaxation = relaxation_of(t),
                        .way = t.worker.edge_way.view(),
                        .position = &t.worker.packed.position},
      t.worker.stats);
}

const char* with_stretch_limit(const World&, const ClothRecord& c) {
  return c.settings.stretch_limit < 1.0f ? kNeeded : "stretch_limit is 1 or more";
}

#ifdef PLEAT_WITH_COLLISION
const char* with_stretch_limit_and_colliders(const World& w, const ClothRecord& c) {
  const char* why = with_colliders(w, c);
  return why != kNeeded ? why : with_stretch_limit(w, c);
}

void respond(ClothTick& t) {
  run(CollisionResponse{.contacts = contacts_of(t),
                        .face_response = static_cast<FaceResponse>(t.settings.face_response),
                        .position = t.worker.packed.position.data()},
      t.worker.stats);
}
#endif

void check_energy(ClothTick& t) {
  const World& w = t.world;
  const std::size_t n = t.garment.particle_count;
  const float* g = w.def.gravity;
  SpeedBound bound{.garment = &t.garment,
                   .start = t.start,
                   .mass = t.mass,
                   .inverse_mass = t.inverse_mass,
                   .pin_previous = t.pin_previous,
                   .pin_next = t.pin_next,
                   .bodies = bodies_met(t),
                   .start_speed = rms_speed(n, t.mass, t.inverse_mass, t.start_velocity),
                   .gravity = length(Vec3{g[0], g[1], g[2]}),
                   .wind = length(t.air),
                   .stiffness = t.settings.stiffness,
                   .bend_stiffness = t.settings.bend_stiffness,
                   .room = t.spring_room,
                   .dt = t.frame_dt,
                   .substep = t.dt};
  assert(bound.validate());
  const float speed = rms_speed(n, t.mass, t.inverse_mass, t.velocity);
  if (!(speed <= bound.least()) && !(speed <= bound.run())) t.trouble = true;
}

constexpr Row kRows[] = {
    {Phase::kContact, "edge_ways",
     [](const World& w, const ClothRecord& c) {
       return with_projection(w, c) == kNeeded ? kNeeded : with_stretch_limit(w, c);
     },
     [](ClothTick& t) {
       run(EdgeWays{.garment = &t.garment, .previous = &t.worker.packed.previous, .way = t.worker.edge_way.view()});
     }},
    // Before contact is looked for, which then is where the springs leave the cloth.
    {Phase::kContact, "elastic_projection", with_projection,
     [](ClothTick& t) {
       run(ElasticProjection{.garment = &t.garment,
                             .law = t.edge_law(),
                             .damping_rate = t.settings.edge_damping,
                             .dt = t.dt,
                             .way = t.worker.edge_way.view(),
                             .position = &t.worker.packed.position,
                             .passes = elastic_passes(t)});
       run_wide(widest_vectors(),
                [&] { unpack(t.worker.packed.position.data(), t.garment.particle_count, t.position); });
     }},
#ifdef PLEAT_WITH_COLLISION
    // Rows of the cloth against itself come before those against bodies, which have the last word.
    {Phase::kContact, "self_candidates", with_itself,
     [](ClothTick& t) {
       World& w = t.world;
       run(SelfCandidates{.garment = &t.garment,
                          .position = t.position,
                          .previous = t.previous,
                          .distance = t.settings.self_distance,
                          .pairs = self_pairs_of(t),
                          .sought_at = w.self.sought_at.view().from(t.cloth.particle_begin),
                          .scratch = &t.worker.near_scratch},
           t.worker.stats);
     }},
    {Phase::kContact, "self_detection", with_itself,
     [](ClothTick& t) {
       run(SelfDetection{.garment = &t.garment,
                         .position = t.worker.packed.position.data(),
                         .begin = t.worker.packed.previous.data(),
                         .previous = t.previous,
                         .inverse_mass = t.inverse_mass,
                         .pairs = self_pairs_of(t),
                         .friction = t.settings.friction,
                         .dt = t.dt,
                         .contacts = contacts_of(t)},
           t.worker.stats);
       t.cloth_rows = t.worker.contact_count;
     }},
    {Phase::kContact, "layer_candidates", with_layers,
     [](ClothTick& t) {
       World& w = t.world;
       run(LayerCandidates{.garment = &t.garment,
                           .position = t.position,
                           .previous = t.previous,
                           .origin = t.cloth.origin,
                           .layer = t.settings.layer,
                           .clothes = layer_cloths(w),
                           .t0 = t.t0,
                           .t1 = t.t1,
                           .distance = t.settings.thickness,
                           .pairs = layer_pairs_of(t),
                           .sought_at = w.layers.sought_at.view().from(t.cloth.particle_begin),
                           .sought = &t.cloth.layers_sought,
                           .around = &t.layers_around,
                           .scratch = &t.worker.near_scratch},
           t.worker.stats);
     }},
    {Phase::kContact, "layer_detection", with_layers,
     [](ClothTick& t) {
       run(LayerDetection{.garment = &t.garment,
                          .position = t.worker.packed.position.data(),
                          .begin = t.worker.packed.previous.data(),
                          .previous = t.previous,
                          .origin = t.cloth.origin,
                          .inverse_mass = t.inverse_mass,
                          .clothes = layer_cloths(t.world),
                          .t0 = t.t0,
                          .t1 = t.t1,
                          .pairs = layer_pairs_of(t),
                          .friction = t.settings.friction,
                          .dt = t.dt,
                          .scratch = &t.worker.near_scratch,
                          .contacts = contacts_of(t)},
           t.worker.stats);
       t.cloth_rows = t.worker.contact_count;
     }},
    {Phase::kContact, "collider_motion", with_capsules,
     [](ClothTick& t) {
       t.capsule_margin = capsule_margin(t.position, t.previous, t.garment.particle_count);
       move_capsules(t, t.settings.thickness + t.capsule_margin);
     }},
    {Phase::kContact, "capsule_candidates", with_capsules,
     [](ClothTick& t) {
       run(CapsuleCandidates{.garment = &t.garment,
                             .position = t.position,
                             .packed = t.worker.packed.position.data(),
                             .capsules = t.worker.capsule_poses.data(),
                             .capsule_count = t.worker.capsule_pose_count,
                             .thickness = t.settings.thickness,
                             .margin = t.capsule_margin,
                             .candidates = &t.worker.capsule_candidates});
     }},
    {Phase::kContact, "capsule_detection", with_capsules,
     [](ClothTick& t) {
       run(CapsuleDetection{.garment = &t.garment,
                            .position = t.worker.packed.position.data(),
                            .previous = t.worker.packed.previous.data(),
                            .capsules = t.worker.capsule_poses.data(),
                            .capsule_count = t.worker.capsule_pose_count,
                            .thickness = t.settings.thickness,
                            .margin = t.capsule_margin,
                            .friction = t.settings.friction,
                            .dt = t.dt,
                            .candidates = &t.worker.capsule_candidates,
                            .contacts = contacts_of(t),
                            .blocks = t.worker.capsule_blocks.data()},
           t.worker.stats);
     }},
    {Phase::kContact, "plane_detection", with_planes,
     [](ClothTick& t) {
       World& w = t.world;
       run(PlaneDetection{.particle_count = t.garment.particle_count,
                          .position = t.position,
                          .previous = t.previous,
                          .origin = t.cloth.origin,
                          .inverse_mass = t.inverse_mass,
                          .planes = w.planes.data(),
                          .plane_count = w.planes.size(),
                          .t0 = t.t0,
                          .t1 = t.t1,
                          .thickness = t.settings.thickness,
                          .friction = t.settings.friction,
                          .dt = t.dt,
                          .contacts = contacts_of(t),
                          .collides_with = t.settings.collides_with},
           t.worker.stats);
     }},
    {Phase::kContact, "mesh_candidates", with_meshes,
     [](ClothTick& t) {
       World& w = t.world;
       run(MeshCandidates{.garment = &t.garment,
                          .position = t.position,
                          .previous = t.previous,
                          .velocity = t.velocity,
                          .inverse_mass = t.inverse_mass,
                          .origin = t.cloth.origin,
                          .bodies = w.bodies.get(),
                          .meshes = w.mesh_pointers.data(),
                          .t0 = t.t0,
                          .t1 = t.t1,
                          .thickness = t.settings.thickness,
                          .dt = t.dt,
                          .candidates = &t.worker.mesh_candidates,
                          .collides_with = t.settings.collides_with});
     }},
    {Phase::kContact, "mesh_detection", with_meshes,
     [](ClothTick& t) {
       World& w = t.world;
       run(MeshDetection{.garment = &t.garment,
                         .position = t.position,
                         .packed = t.worker.packed.position.data(),
                         .previous = t.previous,
                         .inverse_mass = t.inverse_mass,
                         .origin = t.cloth.origin,
                         .bodies = w.bodies.get(),
                         .meshes = w.mesh_pointers.data(),
                         .candidates = &t.worker.mesh_candidates,
                         .t0 = t.t0,
                         .t1 = t.t1,
                         .thickness = t.settings.thickness,
                         .friction = t.settings.friction,
                         .dt = t.dt,
                         .contacts = contacts_of(t),
                         .collides_with = t.settings.collides_with},
           t.worker.stats);
     }},
#endif

    {Phase::kSweep, "coarse_stretch",
     [](const World& w, const ClothRecord& c) {
       return c.garment().coarse.empty() ? "no particle is 16 edges from a pin" : with_stretch_limit(w, c);
     },
     [](ClothTick& t) {
       if (t.sweeps_left <= kExactSweeps) return;
       run(CoarseStretch{.garment = &t.garment,
                         .limit = t.settings.stretch_limit,
                         .relaxation = relaxation_of(t),
                         .way = t.worker.edge_way.view(),
                         .position = &t.worker.packed.position,
                         .begin = &t.worker.packed.begin},
           t.worker.stats);
     }},
    {Phase::kSweep, "stretch_constraint", with_stretch_limit, limit_stretch},
    {Phase::kSweep, "tether_constraint",
     [](const World&, const ClothRecord& c) {
       return c.settings.stretch_limit >= 1.0f        ? "stretch_limit is 1 or more"
              : c.garment().tether_length.size() == 0 ? "no particle is far from a pin"
                                                      : kNeeded;
     },
     [](ClothTick& t) {
       run(TetherConstraint{
           .garment = &t.garment, .limit = t.settings.stretch_limit, .position = t.worker.packed.position.data()});
     }},

#ifdef PLEAT_WITH_COLLISION
    {Phase::kSweep, "collision_response", with_contacts, respond},
    {Phase::kFriction, "contact_friction", with_contacts,
     [](ClothTick& t) {
       run(ContactFriction{.contacts = contacts_of(t),
                           .previous = t.worker.packed.previous.data(),
                           .position = t.worker.packed.position.data()});
     }},
    // Rows of bodies that pinch the cloth push against each other in every sweep; friction takes the sum for pressure
    // and undoes what the strain limit has pulled. So the limit comes once more, and contact still has the last word.
    // Cloth that no body is near has no such pass: it moves as it would in a world without bodies.
    {Phase::kFriction, "stretch_after_friction", with_stretch_limit_and_colliders,
     [](ClothTick& t) {
       if (t.worker.contact_count != t.cloth_rows) limit_stretch(t);
     }},
    // What the limit has pulled must not creep, nor a fold that hangs on it snap; what is stretched may slide.
    {Phase::kFriction, "contact_stick", with_contacts,
     [](ClothTick& t) {
       run(ContactFriction{.contacts = contacts_of(t),
                           .previous = t.worker.packed.previous.data(),
                           .longest = kCreepSpeed * t.dt,
                           .position = t.worker.packed.position.data()});
     }},
    {Phase::kFriction, "collision_last_word", with_contacts, respond},
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
    {Phase::kSubstepEnd, "contact_velocity", with_contacts,
     [](ClothTick& t) { run(ContactVelocity{.contacts = contacts_of(t), .dt = t.dt, .velocity = t.velocity}); }},
#endif
    {Phase::kSubstepEnd, "finite_guard", always,
     [](ClothTick& t) {
       const std::uint64_t before = t.worker.stats.nonfinite_restored;
       run(FiniteGuard{.particle_count = t.garment.particle_count,
                       .previous = t.previous,
                       .position = t.position,
                       .velocity = t.velocity,
                       .origin = t.cloth.origin},
           t.worker.stats);
       t.trouble = t.trouble || t.worker.stats.nonfinite_restored != before;
     }},
    {Phase::kSubstepEnd, "rounding_hold",
     [](const World&, const ClothRecord& c) {
       return c.settings.inner_friction > 0.0f ? kNeeded : "inner_friction is 0";
     },
     [](ClothTick& t) {
       run(RoundingHold{.particle_count = t.garment.particle_count,
                        .previous = t.previous,
                        .position = t.position,
                        .velocity = t.velocity,
                        .dt = t.dt,
                        .friction_dt = t.force_dt,
                        .held = t.world.held.view().from(t.cloth.particle_begin)});
     }},
    {Phase::kCheck, "energy_check", always, check_energy},
    {Phase::kCheck, "sleep",
     [](const World&, const ClothRecord& c) { return c.settings.sleep_speed > 0.0f ? kNeeded : "sleep_speed is 0"; },
     watch_rest},
};

}  // namespace

std::span<const Row> constraint_rows() { return kRows; }

}  // namespace pleat
