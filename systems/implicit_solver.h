// All springs of a cloth solved together.
//   D. Baraff, A. Witkin, "Large Steps in Cloth Simulation", 1998: one Newton step of backward Euler.
//   K.-J. Choi, H.-S. Ko, "Stable but Responsive Cloth", 2002: a short edge adds no negative stiffness.
#pragma once

#include <memory>

#include "components/edge_law.h"
#include "components/garment.h"

namespace pleat {

/// The sparse matrix of a garment's springs, the order in which its particles are eliminated and the pattern of its
/// factor: found once, used by all cloths cut from it, one at a time. Throws std::bad_alloc.
///
/// Its memory is Eigen's own, from malloc and operator new, not the host's: Eigen 3.4 has no allocators, and a factor
/// keeps its numbers in a sparse matrix that cannot lie on foreign memory. A worker's is 1.2 kB a particle for a sheet
/// of 100 particles, 2.3 kB for one of 1000, taken when a cloth is made or gets this integrator.
class ImplicitMatrix {
 public:
  explicit ImplicitMatrix(const Garment& garment);
  ~ImplicitMatrix();

 private:
  friend struct ImplicitIntegration;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// A step of backward Euler, linearised where it begins; `force` holds all forces there, the springs' too:
///   (M + dt^2 K) (v' - v) = dt (F - dt K v),   x' = x + dt v',
///   K = sum over edges of k (max(l/L - r, 0) I + l/L u u^T)
/// with k and r of the line of its law that an edge is on. M + dt^2 K is positive definite at any stiffness. Pins keep
/// their velocity.
/// Reads:  garment edges; inverse_mass (P) 1/kg; force (P) N
/// Writes: position m, velocity m/s (P)
/// Cost:   O(P^1.5) for a sheet, no allocation below 5,000 particles.  Errors: none.
struct ImplicitIntegration {
  const Garment* garment = nullptr;
  ImplicitMatrix* matrix = nullptr;
  const float* inverse_mass = nullptr;
  ConstVec3View force;
  EdgeLaw law;
  float dt = 0.0f;  // s
  Vec3View position, velocity;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
