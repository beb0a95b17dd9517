// Limit on the elongation of edges.
//   X. Provot, "Deformation Constraints in a Mass-Spring Model to Describe Rigid Cloth Behavior", 1995.
//   M. Oshita, A. Makinouchi, 2001, section 4.3.
#pragma once

#include "components/edge_slots.h"
#include "components/stats.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// One pass over the edges, in order: pulls the ends of each over-long edge together along it.
///   C = |d| - (1 + limit) L > 0,  d = x_j - x_i:   x_i += w_i/(w_i + w_j) r C q,   x_j -= w_j/(w_i + w_j) r C q
/// where q is along the edge as the substep began, so long that its component along d is 1 (pull_direction.h).
/// r above 1 pulls too far, as successive over-relaxation does: a pull through many edges then takes fewer passes.
/// Short edges are left alone: edge length control gives them their length back when they are drawn. Moves are weighted
/// by inverse mass, so momentum is kept except at pins.
/// Reads:  slots; way (S) m: edge_ways.h; inverse mass with the positions
/// Writes: position (P) m, packed; stats.edges_skipped
/// Cost:   O(S), no allocation. Errors: none; an edge shorter than 1e-9 m is skipped and counted.
struct StretchConstraint {
  const EdgeSlots* slots = nullptr;  // a garment's, or of a coarse level
  float limit = 0.0f;                // fraction of the rest length
  float relaxation = 1.0f;           // r, below 2
  ConstVec3View way;
  Column<Vec4>* position = nullptr;  // and two places more: edge_slots.h

  bool validate() const;
  void run(Stats& stats, VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
