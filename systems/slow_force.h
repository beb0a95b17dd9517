// Forces that change slowly are found once for several steps.
//   M. Tuckerman, B. Berne, G. Martyna, "Reversible multiple time scale molecular dynamics", 1992: slow forces in long
//   steps, fast ones in short. Here they are held between, where those authors give all their impulse at once: cloth at
//   rest lies still on what does not come and go.
#pragma once

#include <cstddef>

#include "components/column.h"

namespace pleat {

/// F_i += slow_i.
/// Reads:  slow (P) N.  Writes: force (P) N, added to; columns with their padding.  Cost: O(P).  Errors: none.
struct SlowForce {
  std::size_t particle_count = 0;
  ConstVec3View slow;
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
