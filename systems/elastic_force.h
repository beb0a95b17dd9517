// Elastic forces along edges.
//   M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001, eq (1).
#pragma once

#include "components/garment.h"

namespace pleat {

/// Adds the paper's spring force of every edge to both of its ends:
///   F_i = k (l - L)/L (x_j - x_i),   F_j = -F_i,   l = |x_j - x_i|
/// which is eq (1) as a vector; its tangent stiffness at rest is k. Where k is more than a step of dt can carry,
/// (w_i + w_j) k dt^2 > 0.8, that edge is softened to that bound: symplectic Euler then stays stable up to ten edges a
/// particle.
/// Reads:  garment edges; position (P) m; inverse_mass (P) 1/kg
/// Writes: force (P) N, added to
/// Cost:   O(E), no allocation. Errors: none; a collapsed edge gives no force.
struct ElasticForce {
  const Garment* garment = nullptr;
  ConstVec3View position;
  const float* inverse_mass = nullptr;
  float stiffness = 0.0f;  // k, N/m
  float dt = 0.0f;         // s
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
