// Particle normals: the base normals of the mesh, and the paper's normal control by elastic forces.
//   M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001, section 3.2.
#pragma once

#include "components/garment.h"
#include "components/surface.h"

namespace pleat {

/// n_i = N_i / |N_i|, a sum over the faces j around i with unit normals n_j:
///   kPaper      N_i = sum |f_i^j| n_j, eq (3); the base normal only where no force is
///   kPleat      N_i = sum w_ij n_j (1 + |f_i^j| / f0), f0 = the force at 5 % strain of a mean edge; then twice more,
///               with n_j of the face's sides at i as the folds over short edges will bend them
///   others      N_i = sum w_ij n_j: the base normal. w_ij is about 1, less as the face collapses (base_normal.h)
/// f_i^j is eq (4), the sum of the forces of eq (1) along the face's two edges at i. The stiffness k is common to all
/// forces and drops out. What kPleat changes: below f0 the ratios of forces are mostly noise, which turns the normals
/// of eq (3) at random; without w_ij normals jump when a face turns over; a short edge counts as slack, for cloth that
/// is pushed buckles away from its tangent instead of following it; and where cloth waves as closely as its particles
/// lie, flat faces know half of its slope: the rest shows in the length that their edges miss.
/// Reads:  garment faces, edges and rest lengths; position (P) m
/// Writes: normal (P) unit; fold (E), scratch, kPleat only
/// Cost:   O(F + E + P), no allocation. Errors: none; where the faces around cancel, or there is none, the normal is
///         some fixed unit vector.
struct ParticleNormals {
  SurfaceMode mode = SurfaceMode::kPleat;
  const Garment* garment = nullptr;
  ConstVec3View position;
  Vec3View normal;
  Vec3View fold;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
