// Bending of the two faces at an edge against each other.
//   E. Grinspun, A. Hirani, M. Desbrun, P. Schroeder, "Discrete Shells", 2003: the hinge energy.
//   R. Bridson, S. Marino, R. Fedkiw, "Simulation of Clothing with Folds and Wrinkles", 2003: the same mode.
#pragma once

#include "components/garment.h"
#include "components/wide.h"

namespace pleat {

/// Adds the force of E = 1/2 c (theta - theta0)^2, c = B |e|^2 / (A1 + A2), and of damping, for every hinge:
///   F = -(c (theta - theta0) + d theta') grad(theta),   d = rate / W,   W = sum of w_k |g_k|^2
/// With this c a bent sheet of equilateral triangles has the plate's energy B kappa^2 / 2 per area in every direction.
/// c is held below 0.2 / (W dt^2) and the rate below 0.2 / dt, where explicit steps stay stable. Momentum is kept.
/// Reads:  garment hinges; position (P) m; velocity (P) m/s; inverse_mass (P) 1/kg
/// Writes: force (P) N, added to
/// Cost:   O(H), no allocation. Errors: none; a hinge at a face of less than 1e-12 m2 is passed over.
struct HingeBending {
  const Garment* garment = nullptr;
  ConstVec3View position, velocity;
  const float* inverse_mass = nullptr;
  float stiffness = 0.0f;     // B, N m
  float damping_rate = 0.0f;  // 1/s
  float dt = 0.0f;            // s
  Vec3View force;

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
