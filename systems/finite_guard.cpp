#include "systems/finite_guard.h"

#include <algorithm>

#include "components/lanes.h"
#include "components/limits.h"
#include "components/wide.h"

namespace pleat {
namespace {

/// On each axis; false for NaN.
PLEAT_KERNEL LaneMask within(const Vec3Lanes& a, float most) {
  const float most2 = most * most;
  return (a.x * a.x <= most2) & (a.y * a.y <= most2) & (a.z * a.z <= most2);
}

/// Of eight particles, a bit for each that is finite, near and slow.
PLEAT_KERNEL std::uint32_t good_ones(const Vec3Lanes& x, const Vec3Lanes& v) {
  return bits(within(x, kFarthest) & within(v, kFastest));
}

}  // namespace

bool FiniteGuard::validate() const { return previous.x != nullptr && position.x != nullptr && velocity.x != nullptr; }

void FiniteGuard::run(Stats& stats) const {
  run_wide(widest_vectors(), [&] {
    const Vec3Lanes from = all(origin);
    for (std::size_t begin = 0; begin < particle_count; begin += kLanes) {
      const std::uint32_t good =
          good_ones(load(ConstVec3View(position), begin) + from, load(ConstVec3View(velocity), begin));
      if (good == 0xff) continue;
      for (std::size_t i = begin; i < std::min(begin + kLanes, particle_count); ++i) {
        if ((good >> (i - begin) & 1) != 0) continue;
        position.set(i, previous[i]);
        velocity.set(i, {});
        ++stats.nonfinite_restored;
      }
    }
  });
}

}  // namespace pleat
