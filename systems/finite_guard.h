// The last word of a substep: nothing that is not finite leaves it.
#pragma once

#include <cstddef>

#include "components/column.h"
#include "components/stats.h"

namespace pleat {

/// A particle whose position or velocity is not finite, or beyond kFarthest in the world or kFastest on an axis
/// (components/limits.h), goes back to where the substep began and stands still there.
/// Reads:  previous (P) m; the others' padding.  Writes: position m, velocity m/s (P); stats.nonfinite_restored.
/// Cost:   O(P).  Errors: none.
struct FiniteGuard {
  std::size_t particle_count = 0;
  ConstVec3View previous;
  Vec3View position, velocity;
  Vec3 origin{};  // of positions, m in the world

  bool validate() const;
  void run(Stats& stats) const;
};

}  // namespace pleat
