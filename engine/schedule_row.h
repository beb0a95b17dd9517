// What the files of the schedule's rows share: above all, why a row may be left out.
#pragma once

#include "engine/budget.h"
#include "engine/run.h"
#include "engine/schedule_table.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/collider_motion.h"
#include "systems/collision_bodies.h"
#endif

namespace pleat {

constexpr const char* kNeeded = nullptr;
inline const char* always(const World&, const ClothRecord&) { return kNeeded; }

/// Why the integrator does not project the edges of the cloth, or kNeeded.
inline const char* with_projection(const World&, const ClothRecord& c) {
  return c.settings.integrator != PLEAT_INTEGRATOR_PROJECTED ? "edges are forces"
         : c.settings.stiffness == 0.0f                      ? "stiffness is 0"
                                                             : kNeeded;
}

inline const char* without_some_ticks(const World&, const ClothRecord& c) {
  return takes_one_tick_of(c) == 1 ? "the cloth takes every tick" : kNeeded;
}

inline const char* with_colliders(const World& w, const ClothRecord& c) {
  return w.colliders.empty() ? "no collider" : c.settings.collides_with == 0 ? "collides_with is 0" : kNeeded;
}
inline const char* with_capsules(const World& w, const ClothRecord& c) {
  return w.capsules.size() == 0 && !w.colliders.empty() ? "no capsule" : with_colliders(w, c);
}
inline const char* with_planes(const World& w, const ClothRecord& c) {
  return w.planes.size() == 0 && !w.colliders.empty() ? "no plane" : with_colliders(w, c);
}
inline const char* with_meshes(const World& w, const ClothRecord& c) {
  return w.meshes.empty() && !w.colliders.empty() ? "no mesh body" : with_colliders(w, c);
}
inline const char* with_itself(const World&, const ClothRecord& c) {
  return c.settings.self_distance > 0.0f ? kNeeded : "self_distance is 0";
}
inline const char* with_layers(const World&, const ClothRecord& c) {
  return c.settings.layer > 1 ? kNeeded : c.settings.layer == 1 ? "the innermost layer" : "layer is 0";
}
/// Where bodies or other cloths may touch it.
inline const char* with_others(const World& w, const ClothRecord& c) {
  return with_layers(w, c) == kNeeded ? kNeeded : with_colliders(w, c);
}
inline const char* with_contacts(const World& w, const ClothRecord& c) {
  return with_itself(w, c) == kNeeded ? kNeeded : with_others(w, c);
}

inline BodiesMet bodies_met(const ClothTick& t) {
  const World& w = t.world;
  return {.capsules = &w.capsules,
          .meshes = {w.mesh_pointers.data(), w.mesh_pointers.size()},
          .planes = {w.planes.data(), w.planes.size()},
          .collides_with = t.settings.collides_with};
}

#ifdef PLEAT_WITH_COLLISION
/// The poses of the capsules within `reach` of the cloth, m.
inline void move_capsules(ClothTick& t, float reach) {
  World& w = t.world;
  run(ColliderMotion{.capsules = &w.capsules,
                     .bodies = w.bodies.get(),
                     .particle_count = t.garment.particle_count,
                     .position = t.position,
                     .origin = t.cloth.origin,
                     .reach = reach,
                     .t0 = t.t0,
                     .t1 = t.t1,
                     .poses = t.worker.capsule_poses.data(),
                     .capacity = static_cast<std::uint32_t>(t.worker.capsule_poses.size()),
                     .pose_count = &t.worker.capsule_pose_count,
                     .sought = &t.capsules_sought,
                     .collides_with = t.settings.collides_with},
      t.worker.stats);
}

inline ContactList contacts_of(ClothTick& t) {
  return {t.worker.contacts.data(), contact_room(t.cloth), &t.worker.contact_count};
}
inline NearPairList self_pairs_of(ClothTick& t) {
  constexpr std::uint32_t kPairs = SelfColumns::kPairsPerParticle;
  return {t.world.self.pairs.data() + std::size_t{kPairs} * t.cloth.particle_begin, kPairs * t.garment.particle_count,
          &t.cloth.self_pair_count};
}
inline NearPairList layer_pairs_of(ClothTick& t) {
  constexpr std::uint32_t kPairs = SelfColumns::kPairsPerParticle;
  return {t.world.layers.pairs.data() + std::size_t{kPairs} * t.cloth.particle_begin, kPairs * t.garment.particle_count,
          &t.cloth.layer_pair_count};
}
inline std::span<const LayerCloth> layer_cloths(const World& w) {
  return {w.layers.clothes.data(), w.layers.clothes.size()};
}
#endif

}  // namespace pleat
