// Damping of all motion, whatever its direction: still air, in the simplest form.
#pragma once

#include <cstddef>

#include "components/column.h"

namespace pleat {

/// F_i -= rate m_i v_i. The rate is held below 0.5 / dt.
/// Reads:  mass (P) kg; velocity (P) m/s.  Writes: force (P) N, added to; columns with their padding.
/// Cost:   O(P).  Errors: none.
struct AirDamping {
  std::size_t particle_count = 0;
  const float* mass = nullptr;
  ConstVec3View velocity;
  float rate = 0.0f;  // 1/s
  float dt = 0.0f;    // s
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
