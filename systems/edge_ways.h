// Where edges point as a substep begins.
#pragma once

#include "components/garment.h"
#include "components/vec4.h"
#include "components/wide.h"

namespace pleat {

/// way = x_j - x_i, from the first end of every edge that has a slot to its second, and of every edge of a coarse level
/// behind these, once for all passes of a substep that pull along it (pull_direction.h).
/// Reads:  garment slots and coarse levels; previous (P) m, packed, where the substep began
/// Writes: way (garment.way_count) m; the two places behind previous
/// Cost:   O(P + ways), no allocation. Errors: none.
struct EdgeWays {
  const Garment* garment = nullptr;
  Column<Vec4>* previous = nullptr;  // (P) and two places more
  Vec3View way;

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
