// Weight.
#pragma once

#include <cstddef>

#include "components/column.h"

namespace pleat {

/// F_i += m_i g.
/// Reads:  mass (P) kg.  Writes: force (P) N, added to; columns with their padding.  Cost: O(P).  Errors: none.
struct Gravity {
  std::size_t particle_count = 0;
  const float* mass = nullptr;
  Vec3 acceleration;  // g, m/s2
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
