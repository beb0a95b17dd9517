// How short steps have to be for stiff cloth.
//   S. Gershgorin, "Ueber die Abgrenzung der Eigenwerte einer Matrix", 1931: no eigenvalue is larger than the largest
//   sum of a row's magnitudes, here of M^-1 K and of M^-1 D.
#pragma once

#include <cstdint>

#include "components/frequency_rates.h"
#include "components/garment.h"

namespace pleat {

/// Bounds the frequencies of a cloth of these masses:
///   springs   omega^2 <= max_i 2 w_i (edges at i) k, in any shape: an edge's stiffness is k along it, less across
///   hinges    omega^2 <= max_i w_i sum_h |g_hi| sum_k |c_hk| sum_j |g_kj|, in the rest shape; HingeBending bounds
///             folded ones
///   damping   the same sums with 1 / (w_i + w_j) for k, and 1 / sum_j w_j |g_hj|^2 for c_hh
/// Reads:  garment edges, hinges, rest shape; inverse_mass (P) 1/kg
/// Cost:   O(E + H); allocates 3 floats a particle, one a hinge for its time. Errors: std::bad_alloc.
struct FrequencyBound {
  const Garment* garment = nullptr;
  const float* inverse_mass = nullptr;

  bool validate() const;
  FrequencyRates run() const;
};

enum class Scheme { kEuler, kRungeKutta4 };

/// Whether a step is stable, with a fifth to spare:
///   Euler           omega^2 dt^2 + 2 c dt <= 4         the symplectic one; the explicit one gains energy more slowly
///                                                      than the strain limit takes it
///   Runge-Kutta 4   |lambda| dt <= 2.6,   |lambda| <= (c + sqrt(c^2 + 4 omega^2)) / 2     in the worst direction
struct StableStep {
  FrequencyRates rates;
  Scheme scheme = Scheme::kEuler;
  float stiffness = 0.0f;                                              // k, N/m; 0 where springs are not explicit
  float bend_stiffness = 0.0f;                                         // B, N m
  float edge_damping = 0.0f, bend_damping = 0.0f, air_damping = 0.0f;  // 1/s

  bool validate() const;
  /// The largest omega^2 of the springs, 1/s2, that a step of dt s carries beside bending and damping; at least half of
  /// what it carries alone, as hinges are held back in steps that are too long for them.
  float room(float dt) const;
  /// The smallest n from `least` to `most` for which steps of dt / n are stable; most + 1 where none is.
  std::uint32_t run(float dt, std::uint32_t least, std::uint32_t most) const;
};

}  // namespace pleat
