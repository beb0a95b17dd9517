// The engine loop: one table says which systems exist, when each runs, and for which cloths it is left out.
//
//   tick                          once, for the world
//   for each cloth:
//     frame begin                 cloths whose pins have jumped are carried there
//   for each cloth:
//     substep begin               pins and colliders take their places
//     stage                       forces, then integration; Runge-Kutta repeats it four times, stiff bending up to
//                                 four times; soft bending is found 120 times a second and held between
//     contact                     contact rows at the predicted positions
//     sweep                       repeated: strain limit and contact converge together
//     friction                    what slid is held back; contact has the last word
//     substep end                 velocities, and nothing that is not finite
//     check                       once the substeps are done; where it fails they begin anew, see cloth_tick.h
//     frame end                   the drawn surface
//     carried                     in place of all that in ticks that it does without, far off or unseen: turns.h
#pragma once

#include "engine/world.h"

namespace pleat {

/// Decides anew which systems `cloth` needs, makes room for the optional columns that they use, and brings its drawn
/// surface up to date. To be called whenever the cloth, its settings or its place changed. Throws std::bad_alloc.
void refresh(World& world, ClothRecord& cloth);
/// Brings its drawn surface alone up to date.
void draw(World& world, ClothRecord& cloth);
/// The same decision for all cloths, after the scene's gravity or wind changed. Throws std::bad_alloc; all plans are as
/// they were then.
void replan(World& world);

/// What plans and room depend on among the bodies.
struct BodyCensus {
  bool any, any_capsule, any_plane;
  std::size_t capsule_room, meshes;
  bool operator==(const BodyCensus&) const = default;
};
BodyCensus body_census(const World& world);
/// The same after a body came or went: nothing is decided anew unless the census has changed, so that a crowd's bodies
/// take no longer the more there are. Wakes cloths that meet a body of `groups`. Throws std::bad_alloc; all plans are
/// as they were then.
void replan(World& world, const BodyCensus& before, std::uint32_t groups);

/// And for one cloth, whose need of optional columns is as it was: on any thread.
void replan(const World& world, ClothRecord& cloth);

/// Advances the world by dt seconds. Allocates nothing once each cloth has been through a tick.
void tick(World& world, float dt);

/// Writes the plan, a line per system.
void explain(const World& world, pleat_text_fn write, void* user);

}  // namespace pleat
