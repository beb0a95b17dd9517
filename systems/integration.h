// Steps particles through time.
//   W. Press et al., "Numerical Recipes in C", 1992: the classic 4th-order Runge-Kutta method.
//
// The engine sums forces into `force` before each stage. Euler types take one stage; Runge-Kutta takes four: after
// stages 0..2 position and velocity hold the state at which the next forces are wanted, after stage 3 the result.
// Pinned particles have inverse mass 0 and a velocity that carries them, so every scheme moves them in a straight line.
#pragma once

#include <cstddef>

#include "components/column.h"

namespace pleat {

/// v' = v + dt w F;  x' = x + dt v'   (symplectic)     or     x' = x + dt v   (explicit).
/// Reads:  inverse_mass (P) 1/kg; force (P) N.  Writes: position m, velocity m/s (P); columns with their padding.
/// Cost:   O(P).  Errors: none.
struct EulerIntegration {
  std::size_t particle_count = 0;
  const float* inverse_mass = nullptr;
  ConstVec3View force;
  float dt = 0.0f;  // s
  bool symplectic = true;
  Vec3View position, velocity;

  bool validate() const;
  void run() const;
};

/// One stage, 0..3, of x'' = w F(x, v): order 4 where F is smooth.
/// Reads:  inverse_mass (P) 1/kg; force (P) N; start_position (P) m, as it was before stage 0
/// Writes: position m, velocity m/s (P); start_velocity, position_slope, velocity_slope (P): state between stages
/// Cost:   O(P), no allocation.  Errors: none.
struct RungeKuttaIntegration {
  std::size_t particle_count = 0;
  const float* inverse_mass = nullptr;
  ConstVec3View force, start_position;
  float dt = 0.0f;  // s
  int stage = 0;
  Vec3View position, velocity, start_velocity, position_slope, velocity_slope;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
