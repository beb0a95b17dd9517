// What one worker needs to run cloths, one at a time.
#pragma once

#include "components/capsule_block.h"
#include "components/capsule_candidates.h"
#include "components/clearance_plane.h"
#include "components/contacts.h"
#include "components/fold_choice.h"
#include "components/hinge_scratch.h"
#include "components/mesh_candidates.h"
#include "components/near_pairs.h"
#include "components/near_triangles.h"
#include "components/stats.h"
#include "components/surface.h"
#include "components/vec4.h"

namespace pleat {

/// Scratch of a tick, sized for the largest cloth when the scene changes, empty until something needs it; and what its
/// cloths have counted since the tick began.
struct Worker {
  Vec4Columns packed;
  Vec3Column edge_way;         // m, systems/edge_ways.h
  HingeScratch hinge_scratch;  // empty unless a cloth resists bending
  Column<CapsulePose> capsule_poses;
  Column<CapsuleBlock> capsule_blocks;
  CapsuleCandidateColumns capsule_candidates;
  Column<ContactRow> contacts;
  MeshCandidateColumns mesh_candidates;
  NearScratch near_scratch;  // empty unless cloth touches cloth
  FoldChoices fold_choices;  // empty unless a cloth folds
  Vec3Column footprint;      // m, the drawn vertices on the flat coarse triangles; empty unless there are meshes
  Column<float> bulge;       // m, of faces; empty unless a cloth is drawn
  Column<Vec4> normal_sum;   // of normals and of shaded normals; empty unless a cloth is drawn
  Column<ClearancePlane> clearance_planes;
  NearTriangleColumns near_triangles;
  FoldScratch fold_scratch;  // empty unless a cloth relaxes its folds
  std::uint32_t capsule_pose_count = 0, contact_count = 0, clearance_plane_count = 0;

  Stats stats;
  std::uint64_t substeps = 0;
  const std::uint32_t number;  // among the world's

  Worker(std::uint32_t k, std::pmr::memory_resource* m)
      : packed(m),
        edge_way(m),
        hinge_scratch(m),
        capsule_poses(m),
        capsule_blocks(m),
        capsule_candidates(m),
        contacts(m),
        mesh_candidates(m),
        near_scratch(m),
        fold_choices(m),
        footprint(m),
        bulge(m),
        normal_sum(m),
        clearance_planes(m),
        near_triangles(m),
        fold_scratch(m),
        number(k) {}
};

/// For as many capsules near a cloth as a world with `capsules` may have; by doubling, for crowds come one by one.
std::size_t capsule_room(std::size_t capsules);

struct World;
struct ClothRecord;
/// For how many rows of contact, and for how many planes that its surface has yet to satisfy, the cloth has room. That
/// is its own, whatever other cloths have made a worker's columns hold: what finds none is lost, or settled in turn.
std::uint32_t contact_room(const ClothRecord& cloth);
std::uint32_t clearance_room(const ClothRecord& cloth);
/// For this cloth too, where the scene is as it is now. Throws std::bad_alloc.
void make_room(Worker& worker, const World& world, const ClothRecord& cloth);

}  // namespace pleat
