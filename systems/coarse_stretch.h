// The limit on elongation over long ways first.
//   M. Mueller, "Hierarchical Position Based Dynamics", 2008.
#pragma once

#include "components/garment.h"
#include "components/stats.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// For each coarse level, the coarsest first: a pass of StretchConstraint over its edges; then its children move by the
/// weighted mean of how far their parents have come since the first of all. So a pull goes through the whole garment in
/// one sweep, for a third more time than a pass over the edges alone, which carries it about kSweepReach of them far.
/// Reads:  garment coarse levels; way (garment.way_count) m: edge_ways.h; inverse mass with the positions
/// Writes: position (P) m, packed; begin, scratch; stats.edges_skipped
/// Cost:   O(P), no allocation. Errors: as StretchConstraint.
struct CoarseStretch {
  const Garment* garment = nullptr;
  float limit = 0.0f;       // fraction of the rest length
  float relaxation = 1.0f;  // as of StretchConstraint
  ConstVec3View way;
  Column<Vec4>* position = nullptr;  // and two places more: edge_slots.h
  Column<Vec4>* begin = nullptr;     // as many

  bool validate() const;
  void run(Stats& stats, VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
