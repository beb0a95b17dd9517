#include "engine/room.h"

#include <algorithm>
#include <memory>

#include "engine/layers.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/self_candidates.h"
#endif

namespace pleat {
namespace {

constexpr std::size_t kMostCapsulesPerCloth = 1024;     // near one cloth at a time
constexpr std::size_t kContactsPerParticle = 16;        // room for rows; what does not fit is counted
constexpr std::size_t kSelfContactsPerParticle = 32;    // room for rows of cloth that touches cloth
constexpr std::size_t kMeshCandidates = 65536;          // room for pairs with mesh bodies, and as many more
constexpr std::size_t kMeshCandidatesPerParticle = 32;  // for each particle
constexpr std::size_t kMostClearancePlanes = 4096;      // settled together; more are settled in turn

template <class Column>
void at_least(Column& column, std::size_t size) {
  if (column.size() < size) column.resize(size);
}

/// All columns get the size, or, where memory runs out, none.
template <class... Columns>
void resize_together(std::size_t size, Columns&... columns) {
  (columns.reserve(size), ...);
  (columns.resize(size), ...);
}

void make_dynamics_room(World& world, const ClothRecord& cloth) {
  const std::size_t particles = world.particles.mass.size();
  at_least(world.packed_particles, cloth.garment().particle_count);
  if (cloth.settings.inner_friction > 0.0f || world.held.size() != 0) world.held.resize(particles);
  if (cloth.settings.integrator == PLEAT_INTEGRATOR_RUNGE_KUTTA_4 || world.runge_kutta.start_velocity.size() != 0) {
    resize_together(particles, world.runge_kutta.start_velocity, world.runge_kutta.position_slope,
                    world.runge_kutta.velocity_slope);
  }
  if (cloth.settings.integrator == PLEAT_INTEGRATOR_IMPLICIT_EULER && cloth.source->implicit == nullptr) {
    cloth.source->implicit = std::make_unique<ImplicitMatrix>(cloth.garment());
  }
}

void make_surface_room(World& world, const ClothRecord& cloth) {
  const Garment& g = cloth.garment();
  const bool curved = cloth.settings.surface != PLEAT_SURFACE_FLAT && cloth.pattern() != nullptr;
  std::size_t normals = 0, edges = 0;
  for (const ClothRecord& other : world.clothes) {
    normals += padded(other.garment().normal_count);
    edges += padded(other.garment().edge_count);
  }
  if (curved || world.surface.normal.size() != 0) world.surface.normal.resize(normals);
  const bool folded = curved && has_folds(static_cast<SurfaceMode>(cloth.settings.surface));
  if (folded || world.surface.fold.size() != 0) {
    resize_together(edges, world.surface.fold, world.surface.fold_height, world.surface.fold_side);
  }
  if ((cloth.settings.tangents != 0 && cloth.pattern() != nullptr) || world.drawn.tangent.size() != 0) {
    resize_together(world.drawn.position.size(), world.drawn.tangent, world.drawn.handedness);
  }
  if (!folded || cloth.settings.surface != PLEAT_SURFACE_PLEAT) return;
  at_least(world.fold_choices, g.edge_count);
  at_least(world.fold_springs, (std::size_t{g.face_count} + kLanes - 1) / kLanes);
  FoldScratch& scratch = world.fold_scratch;
  if (cloth.settings.fold_sweeps > 0 && scratch.freedom.size() < g.edge_count) {
    resize_together(g.edge_count, scratch.middle, scratch.pull, scratch.half_length, scratch.freedom);
  }
}

/// For cloth that touches cloth.
void make_cloth_contact_room(World& world, [[maybe_unused]] const ClothRecord& cloth) {
  const bool touches_itself = cloth.settings.self_distance > 0.0f;
  if (touches_itself || world.self.pairs.size() != 0) {
    const std::size_t particles = world.particles.mass.size();
    at_least(world.self.sought_at, particles);
    at_least(world.self.pairs, SelfColumns::kPairsPerParticle * particles);
  }
#ifdef PLEAT_WITH_COLLISION
  const Garment& g = cloth.garment();
  make_layer_room(world, cloth);
  if (touches_itself || cloth.settings.layer > 1) {
    at_least(world.contacts, kSelfContactsPerParticle * std::size_t{g.particle_count});
  }
  if (touches_itself) {
    at_least(world.near_scratch.pairs, SelfColumns::kPairsPerParticle * std::size_t{g.particle_count});
    world.near_scratch.grid.make_room(NearSearch::most_points(g));
    at_least(world.near_scratch.middle, g.edge_count);
  }
#endif
}

void make_body_contact_room(World& world, const ClothRecord& cloth) {
  if (world.colliders.empty()) return;
  const Garment& g = cloth.garment();
  at_least(world.capsule_poses, std::min<std::size_t>(world.capsules.size(), kMostCapsulesPerCloth));
  at_least(world.contacts, kContactsPerParticle * std::size_t{g.particle_count});
  CapsuleCandidateColumns& candidates = world.capsule_candidates;
  at_least(candidates.near, FeatureWords(g).end * world.capsule_poses.size());
  at_least(candidates.sought, world.capsule_poses.size());
  at_least(candidates.anchor, g.particle_count);
  CapsuleScratch& scratch = world.capsule_scratch;
  at_least(scratch.core, g.particle_count);
  at_least(scratch.ends, g.particle_count), at_least(scratch.edge, g.edge_count);
  if (!world.meshes.empty()) {
    at_least(world.mesh_candidates.pairs, kMeshCandidates + kMeshCandidatesPerParticle * g.particle_count);
    at_least(world.mesh_candidates.anchor, g.particle_count);
    at_least(world.mesh_candidates.drift, g.particle_count);
  }
  if (const TessellationPattern* pattern = cloth.pattern(); pattern != nullptr) {
    at_least(world.footprint, pattern->vertex_count);
    at_least(world.clearance_planes, std::min<std::size_t>(pattern->triangle_count, kMostClearancePlanes));
    for (const MeshRecord& body : world.meshes) at_least(world.near_triangles, body.mesh.triangles.size() / 3);
  }
}

}  // namespace

void make_room(World& world, const ClothRecord& cloth) {
  make_dynamics_room(world, cloth);
  make_surface_room(world, cloth);
  make_cloth_contact_room(world, cloth);
  make_body_contact_room(world, cloth);
}

}  // namespace pleat
