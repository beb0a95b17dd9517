// Elastic forces along edges.
//   M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001, eq (1).
#pragma once

#include "components/edge_law.h"
#include "components/garment.h"

namespace pleat {

/// Adds the paper's spring force of every edge to both of its ends:
///   F_i = k (l - L)/L (x_j - x_i),   F_j = -F_i,   l = |x_j - x_i|
/// which is eq (1) as a vector; its tangent stiffness at rest is k. Past its buckling an edge is softer (edge_law.h).
/// Where k is more than a step can carry, that edge is softened to what it can (frequency_bound.h):
/// 2 w (edges at) k <= room at both ends.
/// Reads:  garment edges; position (P) m; inverse_mass (P) 1/kg
/// Writes: force (P) N, added to
/// Cost:   O(E), no allocation. Errors: none; a collapsed edge gives no force.
struct ElasticForce {
  const Garment* garment = nullptr;
  ConstVec3View position;
  const float* inverse_mass = nullptr;
  EdgeLaw law;
  float room = 0.0f;  // 1/s2, the largest omega^2 that a step is stable with
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
