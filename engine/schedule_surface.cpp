// Rows at the end of a frame: what was left behind, and the drawn surface; and of ticks that a cloth does without.
#include "engine/schedule_row.h"
#include "engine/turns.h"
#include "systems/stray_carry.h"
#ifdef PLEAT_WITH_SMOOTHING
#include "systems/drawn_normals.h"
#include "systems/drawn_tangents.h"
#include "systems/edge_length.h"
#include "systems/fold_fade.h"
#include "systems/fold_relaxation.h"
#include "systems/fold_sides.h"
#include "systems/particle_normals.h"
#include "systems/tessellation.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/mesh_clearance.h"
#include "systems/surface_clearance.h"
#endif
#endif

namespace pleat {

namespace {

const char* with_strays(const World&, const ClothRecord& c) {
  return c.garment().strays.size() == 0 ? "every vertex has a triangle or is a pin" : kNeeded;
}

#ifdef PLEAT_WITH_SMOOTHING
/// `condition`, where somebody sees the cloth.
template <const char* (*condition)(const World&, const ClothRecord&)>
const char* where_seen(const World& w, const ClothRecord& c) {
  return c.visible ? condition(w, c) : "nobody sees the cloth";
}

SurfaceMode surface_mode(const pleat_cloth_settings& s) { return static_cast<SurfaceMode>(s.surface); }

const char* with_normals(const World&, const ClothRecord& c) {
  return c.settings.surface == PLEAT_SURFACE_FLAT ? "flat surface" : kNeeded;
}
const char* with_folds(const World&, const ClothRecord& c) {
  return c.settings.surface == PLEAT_SURFACE_FLAT ? "flat surface"
         : !has_folds(surface_mode(c.settings))   ? "surface without folds, edges keep their curve"
         : c.fold_share == 0.0f                   ? "folds are given up for the budget"
                                                  : kNeeded;
}
const char* with_fading(const World& w, const ClothRecord& c) {
  if (const char* why = with_folds(w, c); why != kNeeded) return why;
  return c.fold_share == 1.0f ? "folds are drawn in full" : kNeeded;
}
const char* with_tangents(const World&, const ClothRecord& c) {
  return c.settings.tangents == 0 ? "tangents is 0" : kNeeded;
}

const char* with_fold_relaxation(const World& w, const ClothRecord& c) {
  return c.settings.fold_sweeps == 0                 ? "fold_sweeps = 0"
         : c.settings.surface != PLEAT_SURFACE_PLEAT ? "folds of another surface, or none"
                                                     : with_folds(w, c);
}

#ifdef PLEAT_WITH_COLLISION
/// Half of the cloth's thickness; the rest is left to contact that is not exact.
float surface_clearance(const ClothTick& t) { return 0.5f * t.settings.thickness; }

ClearanceList clearance_planes(ClothTick& t) {
  return {t.worker.clearance_planes.data(), clearance_room(t.cloth), &t.worker.clearance_plane_count};
}
#endif

const char* with_sides(const World& w, const ClothRecord& c) {
  return c.settings.surface == PLEAT_SURFACE_PAPER ? "the paper folds outwards" : with_folds(w, c);
}

/// For tessellation to tell how far the surface bulges where bodies ask for it, and no mesh moves the surface first.
float* bulge(const ClothTick& t) {
  const bool asked = t.world.has_colliders() && t.world.meshes.empty();
  return asked && Tessellation::tells_bulge(surface_mode(t.settings)) ? t.worker.bulge.data() : nullptr;
}

/// Where fold sides have made them already.
const FoldCurve* fold_curves(const ClothTick& t) {
  return with_sides(t.world, t.cloth) == kNeeded ? t.worker.fold_choices.curves.data() : nullptr;
}

#endif

constexpr Row kRows[] = {
    {Phase::kFrameEnd, "stray_carry", with_strays,
     [](ClothTick& t) {
       run(StrayCarry{&t.garment, t.position, t.velocity});
     }},
#ifdef PLEAT_WITH_SMOOTHING
    {Phase::kFrameEnd, "particle_normals", where_seen<with_normals>,
     [](ClothTick& t) {
       run(ParticleNormals{.mode = surface_mode(t.settings),
                           .garment = &t.garment,
                           .position = t.position,
                           .normal = t.normal,
                           .sum = t.worker.normal_sum.data(),
                           .place = t.worker.packed.position.data()});
     }},
    {Phase::kFrameEnd, "fold_sides", where_seen<with_sides>,
     [](ClothTick& t) {
       run(FoldSides{.garment = &t.garment,
                     .position = t.position,
                     .normal = t.normal,
                     .choices = &t.worker.fold_choices,
                     .kept = t.cloth.sides_known ? FoldSides::kept_after(t.frame_dt) : 0.0f,
                     .side = t.fold_side});
       t.cloth.sides_known = true;
     }},
    {Phase::kFrameEnd, "edge_length", where_seen<with_folds>,
     [](ClothTick& t) {
       run(EdgeLength{.mode = surface_mode(t.settings),
                      .garment = &t.garment,
                      .position = t.position,
                      .normal = t.normal,
                      .fold = t.fold,
                      .fold_height = t.fold_height,
                      .side = t.fold_side,
                      .curves = fold_curves(t)});
     }},
    {Phase::kFrameEnd, "fold_relaxation", where_seen<with_fold_relaxation>,
     [](ClothTick& t) {
       run(FoldRelaxation{.sweeps = t.settings.fold_sweeps,
                          .garment = &t.garment,
                          .position = t.position,
                          .normal = t.normal,
                          .fold = t.fold,
                          .fold_height = t.fold_height,
                          .scratch = t.worker.fold_scratch.view()});
     }},
    {Phase::kFrameEnd, "fold_fade", where_seen<with_fading>,
     [](ClothTick& t) {
       run(FoldFade{.edge_count = t.garment.edge_count, .share = t.cloth.fold_share, .fold_height = t.fold_height});
     }},
    {Phase::kFrameEnd, "tessellation", where_seen<always>,
     [](ClothTick& t) {
       run(Tessellation{.mode = surface_mode(t.settings),
                        .garment = &t.garment,
                        .pattern = t.cloth.pattern(),
                        .position = t.position,
                        .normal = t.normal,
                        .fold = t.fold,
                        .fold_height = t.fold_height,
                        .drawn_position = t.drawn_position,
                        .curves = fold_curves(t),
                        .bulge = bulge(t)});
     }},
#ifdef PLEAT_WITH_COLLISION
    {Phase::kFrameEnd, "surface_footprint", where_seen<with_meshes>,
     [](ClothTick& t) {
       run(Tessellation{.mode = SurfaceMode::kFlat,
                        .garment = &t.garment,
                        .pattern = t.cloth.pattern(),
                        .position = t.position,
                        .normal = {},
                        .fold = {},
                        .drawn_position = t.worker.footprint.view()});
     }},
    {Phase::kFrameEnd, "surface_capsules", where_seen<with_capsules>,
     [](ClothTick& t) {
       move_capsules(t, t.garment.mean_edge_length);  // the surface bulges less than that
     }},
    {Phase::kFrameEnd, "mesh_clearance", where_seen<with_meshes>,
     [](ClothTick& t) {
       World& w = t.world;
       run(MeshClearance{.garment = &t.garment,
                         .pattern = t.cloth.pattern(),
                         .footprint = t.worker.footprint.view(),
                         .origin = t.cloth.origin,
                         .bodies = w.bodies.get(),
                         .meshes = w.mesh_pointers.data(),
                         .collides_with = t.settings.collides_with,
                         .t = t.t1,
                         .clearance = surface_clearance(t),
                         .near = t.worker.near_triangles.view(),
                         .planes = clearance_planes(t),
                         .drawn_position = t.drawn_position});
     }},
    {Phase::kFrameEnd, "surface_clearance", where_seen<with_colliders>,
     [](ClothTick& t) {
       World& w = t.world;
       run(SurfaceClearance{.garment = &t.garment,
                            .pattern = t.cloth.pattern(),
                            .position = t.position,
                            .origin = t.cloth.origin,
                            .capsules = t.worker.capsule_poses.data(),
                            .capsule_count = w.capsules.size() != 0 ? t.worker.capsule_pose_count : 0,
                            .half_spaces = w.planes.data(),
                            .half_space_count = w.planes.size(),
                            .collides_with = t.settings.collides_with,
                            .t = t.t1,
                            .clearance = surface_clearance(t),
                            .bulge = bulge(t),
                            .planes = clearance_planes(t),
                            .drawn_position = t.drawn_position});
     }},
#endif
    {Phase::kFrameEnd, "drawn_normals", where_seen<always>,
     [](ClothTick& t) {
       run(DrawnNormals{.pattern = t.cloth.pattern(),
                        .position = t.drawn_position,
                        .sum = t.worker.normal_sum.data(),
                        .normal = t.drawn_normal});
     }},
    {Phase::kFrameEnd, "drawn_tangents", where_seen<with_tangents>,
     [](ClothTick& t) {
       run(DrawnTangents{.garment = &t.garment,
                         .pattern = t.cloth.pattern(),
                         .position = t.drawn_position,
                         .normal = t.drawn_normal,
                         .tangent = t.drawn_tangent,
                         .handedness = t.drawn_handedness});
     }},
#endif

    {Phase::kCarried, "carry_with_pins", without_some_ticks, carry_with_pins},
#ifdef PLEAT_WITH_SMOOTHING
    {Phase::kCarried, "carry_surface", where_seen<without_some_ticks>, carry_surface},
#endif
};

}  // namespace

std::span<const Row> surface_rows() { return kRows; }

}  // namespace pleat
