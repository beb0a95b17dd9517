#include "engine/worker.h"

#include <algorithm>
#include <bit>

#include "engine/world.h"

namespace pleat {
namespace {

constexpr std::size_t kMostCapsulesPerCloth = 1024;     // near one cloth at a time
constexpr std::uint32_t kContactsPerParticle = 16;      // room for rows; what does not fit is counted
constexpr std::uint32_t kSelfContactsPerParticle = 32;  // room for rows of cloth that touches cloth
constexpr std::size_t kMeshPairsPerTriangle = 64;       // room for pairs of edges with a body of few triangles
constexpr std::size_t kMostMeshPairs = 262144;          // the same of many
constexpr std::size_t kMeshPairsPerParticle = 64;       // room besides
constexpr std::uint32_t kMostClearancePlanes = 4096;    // settled together; more are settled in turn

/// Itself, or one of a lower layer.
bool touches_cloth(const ClothRecord& cloth) { return cloth.settings.self_distance > 0.0f || cloth.settings.layer > 1; }

void make_surface_room(Worker& worker, const ClothRecord& cloth) {
  const Garment& g = cloth.garment();
  if (cloth.pattern() == nullptr) return;
  at_least(worker.normal_sum, std::max(cloth.pattern()->shaded_count() + kLanes, g.normal_count));
  at_least(worker.bulge, g.face_count);
  if (cloth.settings.surface != PLEAT_SURFACE_PLEAT) return;
  worker.fold_choices.make_room(g.edge_count, g.face_count);
  if (cloth.settings.fold_sweeps == 0) return;
  FoldScratch& scratch = worker.fold_scratch;
  at_least(scratch.middle, g.edge_count);
  at_least(scratch.pull, g.edge_count);
  at_least(scratch.half_length, g.edge_count);
  at_least(scratch.freedom, g.edge_count);
}

#ifdef PLEAT_WITH_COLLISION
void make_cloth_contact_room(Worker& worker, const ClothRecord& cloth) {
  if (!touches_cloth(cloth) && cloth.settings.layer == 0) return;
  const Garment& g = cloth.garment();
  if (touches_cloth(cloth)) at_least(worker.contacts, contact_room(cloth));
  NearScratch& scratch = worker.near_scratch;
  at_least(scratch.pairs, SelfColumns::kPairsPerParticle * std::size_t{g.particle_count});
  scratch.make_room(g.particle_count, g.edge_count);
}

void make_body_contact_room(Worker& worker, const World& world, const ClothRecord& cloth) {
  if (world.colliders.empty()) return;
  const Garment& g = cloth.garment();
  at_least(worker.capsule_poses, capsule_room(world.capsules.size()));
  at_least(worker.capsule_blocks, capsule_blocks(worker.capsule_poses.size()));
  at_least(worker.contacts, contact_room(cloth));
  worker.capsule_candidates.make_room(g, worker.capsule_poses.size());
  if (!world.meshes.empty()) {
    std::size_t most_vertices = 0, most_triangles = 0;
    for (const MeshRecord& body : world.meshes) {
      most_vertices = std::max(most_vertices, body.mesh.next.size());
      most_triangles = std::max(most_triangles, body.mesh.triangles.size() / 3);
    }
    const std::size_t pairs = std::min(kMeshPairsPerTriangle * most_triangles, kMostMeshPairs);
    worker.mesh_candidates.make_room(g.particle_count, world.meshes.size(), most_vertices, most_triangles,
                                     pairs + kMeshPairsPerParticle * g.particle_count);
  }
  if (const TessellationPattern* pattern = cloth.pattern(); pattern != nullptr) {
    if (!world.meshes.empty()) at_least(worker.footprint, pattern->vertex_count);
    at_least(worker.clearance_planes, clearance_room(cloth));
    for (const MeshRecord& body : world.meshes) worker.near_triangles.make_room(body.mesh.triangles.size() / 3);
  }
}
#endif

}  // namespace

std::size_t capsule_room(std::size_t capsules) {
  return capsules == 0 ? 0 : std::min(std::bit_ceil(capsules), kMostCapsulesPerCloth);
}

std::uint32_t contact_room(const ClothRecord& cloth) {
  return (touches_cloth(cloth) ? kSelfContactsPerParticle : kContactsPerParticle) * cloth.garment().particle_count;
}

std::uint32_t clearance_room(const ClothRecord& cloth) {
  return std::min(cloth.pattern()->triangle_count, kMostClearancePlanes);
}

void make_room(Worker& worker, [[maybe_unused]] const World& world, const ClothRecord& cloth) {
  worker.packed.make_room(cloth.garment().particle_count);
  at_least(worker.edge_way, std::max(cloth.garment().way_count, 1u));  // not null where all particles are pins
  if (resists_bending(cloth)) {
    worker.hinge_scratch.make_room(cloth.garment().hinge_count);
  }
  make_surface_room(worker, cloth);
#ifdef PLEAT_WITH_COLLISION
  make_cloth_contact_room(worker, cloth);
  make_body_contact_room(worker, world, cloth);
#endif
}

}  // namespace pleat
