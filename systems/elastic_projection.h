// Elastic edges that are stable at any stiffness.
//   M. Macklin et al., "Small Steps in Physics Simulation", 2019: one pass over compliant constraints a substep.
//   M. Oshita, A. Makinouchi, 2001, eq (1).
#pragma once

#include "components/edge_law.h"
#include "components/garment.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// Passes over the edges, in order, in place of ElasticForce and EdgeDamping: moves the ends of each to where the
/// forces of both at the end of the step would bring them, were they alone in the world,
///   x_i += w_i dt^2 F / (1 + (w_i + w_j) (dt^2 k/L + c dt/l0) q.d/l),   x_j likewise with -F
///   F = (k (l - L)/L + c (l - l0)/(l0 dt)) q,   c = rate / (w_i + w_j)
/// where d = x_j - x_i, q is the same where the step began, and l0 its length (pull_direction.h).
/// For soft edges that is their force, for stiff ones the rest length; it never overshoots. Momentum is kept. An edge
/// that would end past its buckling is solved on that line of its law. Each further pass adds as
/// much stiffness and damping again, for passes keep no multipliers.
/// Reads:  garment slots; way (S) m: edge_ways.h
/// Writes: position (P) m, packed.  Cost: O(S passes), no allocation.  Errors: none.
struct ElasticProjection {
  const Garment* garment = nullptr;
  EdgeLaw law;                // stiffness > 0
  float damping_rate = 0.0f;  // 1/s
  float dt = 0.0f;            // s
  ConstVec3View way;
  Column<Vec4>* position = nullptr;  // (P) and two places more
  std::uint32_t passes = 1;

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
