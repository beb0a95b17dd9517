// Particle normals: the base normals of the mesh, and the paper's normal control by elastic forces.
//   M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001, section 3.2.
#pragma once

#include "components/garment.h"
#include "components/surface.h"
#include "components/vec4.h"

namespace pleat {

/// n_i = N_i / |N_i|, a sum over the faces j around i with unit normals n_j:
///   kPaper      N_i = sum |f_i^j| n_j, eq (3); the base normal only where no force is
///   kPleat      the base normal, tilted twice by the folds that the short edges at i will need
///   others      N_i = sum w_ij n_j: the base normal. w_ij is about 1, less as the face collapses (base_normal.h)
/// f_i^j is eq (4), the sum of the forces of eq (1) along the face's two edges at i. The stiffness k is common to all
/// forces and drops out. kPleat leaves forces aside: on relaxed cloth their ratios are noise, which turns the normals
/// of eq (3) at random, and held against fine solutions they bring normals no closer to the truth. What does: where
/// cloth waves as closely as its particles lie, flat faces show half of its slope, and the length that their edges
/// miss shows the rest. Without short edges the normals are the base normals, bit for bit.
/// Reads:  garment faces, edges and rest lengths; position (P) m
/// Writes: normal (N) unit, as the garment counts them; sum, place, scratch
/// Cost:   O(F + E + P), no allocation.
/// Errors: none; where the faces around cancel, or there is none, the normal is some fixed unit vector.
struct ParticleNormals {
  SurfaceMode mode = SurfaceMode::kPleat;
  const Garment* garment = nullptr;
  ConstVec3View position;
  Vec3View normal;
  Vec4* sum = nullptr;    // (N), a column: of what becomes normals
  Vec4* place = nullptr;  // (P), a column: m and, w, the share of a tilt; for kPleat only

  bool validate() const;
  void run() const;
};

}  // namespace pleat
