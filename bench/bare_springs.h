// What all converged solutions of bench are solved with.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/pleat.h"

namespace pleat::bench {

inline constexpr uint32_t kMostSubsteps = 64;  ///< a tick

/// Springs of `stiffness`, N/m, both ways, no strain limit, no friction of threads, symplectic Euler: what converges as
/// mesh and step are made finer.
inline void use_bare_springs(pleat_cloth_settings& s, float stiffness, uint32_t substeps) {
  s.substeps = substeps;
  s.sweeps = 1;
  s.integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER;
  s.stiffness = stiffness;
  s.buckling_strain = 1.0f;
  s.stretch_limit = 1.0f;
  s.inner_friction = 0.0f;
}

/// Damped so that a fine mesh comes to rest soon, and not elsewhere; drawn flat.
inline void damp_to_rest(pleat_cloth_settings& s) {
  s.edge_damping = s.bend_damping = 40.0f;
  s.surface = PLEAT_SURFACE_FLAT;
  s.level = 1;
}

/// The farthest that any of the particles (P,3) went, m.
inline double largest_motion(std::span<const float> before, std::span<const float> after) {
  double largest = 0.0;
  for (size_t i = 0; i < after.size(); i += 3) {
    const auto along = [&](size_t axis) { return double(after[i + axis]) - double(before[i + axis]); };
    largest = std::max(largest, std::hypot(along(0), along(1), along(2)));
  }
  return largest;
}

}  // namespace pleat::bench
