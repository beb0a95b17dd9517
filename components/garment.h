// The garment asset: everything about a piece of clothing that does not change while it is worn. Built once from a
// mesh, immutable, shared by all cloths cut from it.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <numbers>
#include <span>
#include <vector>

#include "components/coarse_levels.h"
#include "components/column.h"
#include "components/edge_slots.h"
#include "components/mesh.h"

namespace pleat {

inline constexpr std::uint32_t kNone = 0xffffffffu;

struct Garment {
  explicit Garment(std::pmr::memory_resource* memory);

  std::uint32_t particle_count = 0, face_count = 0, edge_count = 0, hinge_count = 0, border_edge_count = 0;
  float area = 0.0f;              // m2
  float mean_edge_length = 0.0f;  // m

  // Particles (P). uv has 2 floats a particle, or is empty.
  Vec3Column rest_position;  // m
  Column<float> uv;
  Column<float> particle_area;     // m2, a third of the adjacent faces' area; 0 where no face is
  Column<float> added_mass;        // kg, besides the cloth's own
  Column<std::uint8_t> pinned;     // 1 where the host moves the particle
  Column<std::uint32_t> pins;      // pinned particles in the host's order
  Column<std::uint32_t> edges_at;  // how many meet there
  Column<std::uint32_t> strays;    // those that no face uses and no pin moves: they lie, and are kept, on stray_on
  std::uint32_t stray_on = 0;      // a particle with a face, in the middle

  // Faces (F). Edge k of a face joins its corners k and (k + 1) % 3.
  Column<std::uint32_t> face_particle[3], face_edge[3];
  Column<float> face_rest_area;  // m2
  // All faces by clusters of those that lie together (face_clusters.h), and where in that list each cluster ends.
  Column<std::uint32_t> clustered_faces, cluster_end;

  // Edges (E), each once, in the order in which they are solved (edge_order.h); first particle < second.
  Column<std::uint32_t> edge_particle[2];
  Column<std::uint32_t> edge_face[2];    // the second is kNone on the border
  Column<float> edge_rest_length;        // m
  Column<float> edge_rest_curve_length;  // m, of the PN curve over the edge at rest: what edge length control aims at

  EdgeSlots slots;                       // those of the edges that have an end to move
  std::pmr::vector<CoarseLevel> coarse;  // the coarsest first; coarse_levels.h
  std::uint32_t way_count = 0;           // slots of edges and, after them, of levels: edge_ways.h

  /// Edges from the farthest particle to a pin; without pins, about half of the way across its first part.
  std::uint32_t depth = 0;
  // Tethers (T): ways over the surface from particles to their nearest two pins; see tethers.h. First the nearest pins,
  // then the others, each padded to runs of kLanes that share no particle with tethers of slots.empty_place. None where
  // the garment is less than kSweepReach deep.
  Column<std::uint32_t> tether_particle, tether_pin;
  Column<float> tether_length;  // m

  // Hinges (H), one for each edge between two faces: particles 0 and 1 are the edge, in the winding of face A;
  // 2 is the tip of face A and 3 that of face B.
  Column<std::uint32_t> hinge_particle[4];
  Column<float> hinge_rest_angle;  // rad
  // Times B, for the turns theta from rest: energy = sum over h of theta_h (shape_h theta_h + sum over k of coupling_kh
  // theta_beside_kh) / 2, N m; see hinge_stiffness.h. Beside are the other hinges of face A, then those of face B; the
  // hinge itself, with coupling 0, where there is none.
  Column<float> hinge_shape, hinge_coupling[4];
  Column<std::uint32_t> hinge_beside[4];
  Column<float> hinge_bound;  // shape + sum of |coupling|

  // Normals (N): first one for each particle, over all faces around it; then, where creases part these, one for each
  // part; then one for each end of a crease that lies between two parts, the sum of these, so that both sides of the
  // crease meet in one curve. Without creases N = P and all indices are the particles'.
  std::uint32_t normal_count = 0, crease_count = 0;
  Column<std::uint8_t> edge_is_crease;
  Column<std::uint32_t> face_normal[3], edge_normal[2];  // at the corners and ends
  Column<std::uint32_t> part_particle;                   // of each part, ascending
  Column<std::uint32_t> end_part[2];                     // of each such end: the normals of the two parts

  // Faces around each particle i: faces_around[around_begin[i] .. around_begin[i + 1]), ascending.
  Column<std::uint32_t> around_begin, faces_around;
};

struct GarmentInput {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;  // already through check_and_repair
  std::span<const float> uvs;           // 2 a vertex, or empty
  std::span<const std::uint32_t> pins;  // distinct, < positions.size()
  std::span<const std::array<std::uint32_t, 2>> seams;
  float crease_angle = std::numbers::pi_v<float>;  // rad; components/creases.h
  std::span<const float> added_mass = {};          // kg a particle, or empty: none
};

/// Builds the asset. Throws std::bad_alloc; the input must satisfy the notes above.
Garment build_garment(const GarmentInput& input, std::pmr::memory_resource* memory);

}  // namespace pleat
