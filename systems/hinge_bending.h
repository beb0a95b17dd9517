// Bending of the two faces at an edge against each other.
//   E. Grinspun, A. Hirani, M. Desbrun, P. Schroeder, "Discrete Shells", 2003: the hinge energy.
//   R. Bridson, S. Marino, R. Fedkiw, "Simulation of Clothing with Folds and Wrinkles", 2003: the same mode.
#pragma once

#include "components/garment.h"
#include "components/hinge_scratch.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// Adds the force of bending and of its damping for every hinge h,
///   F = -(s_h B sum over k of c_hk s_k (theta_k - theta0_k) + d_h theta_h') grad(theta_h),   d_h = rate / W_h
/// W_h = sum of w_i |g_hi|^2, c the garment's shapes and couplings (components/hinge_stiffness.h): minus the gradient
/// of its energy. s_h^2 <= 0.2 / (W_h dt^2 B sum of |c_hk|) and rate <= 0.2 / dt hold both to what explicit steps
/// carry. Sharp folds of a fine mesh get energy from explicit steps: step_damping * W_h dt B sum of |c_hk| is the least
/// rate; with 1 it is what a step of backward Euler takes. Momentum is kept.
/// Reads:  garment hinges; position (P) m; velocity (P) m/s; inverse_mass (P) 1/kg
/// Writes: force (P) N, added to; scratch
/// Cost:   O(H), no allocation. Errors: none; a hinge at a face of less than 1e-12 m2 is passed over.
struct HingeBending {
  const Garment* garment = nullptr;
  ConstVec3View position, velocity;
  const float* inverse_mass = nullptr;
  float stiffness = 0.0f;     // B, N m
  float damping_rate = 0.0f;  // 1/s
  float dt = 0.0f;            // s
  Vec4Columns* packed = nullptr;
  HingeScratch* scratch = nullptr;
  Vec3View force;
  float step_damping = 0.0f;  // share of backward Euler's damping that there is at least

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
