#include "systems/finite_guard.h"

#include <algorithm>

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {
namespace {

constexpr float kFarthest = 1e6f, kFastest = 1e5f;

/// Of eight particles, a bit for each that is finite, near and slow.
PLEAT_KERNEL std::uint32_t good_ones(const Vec3Lanes& x, const Vec3Lanes& v) {
  return bits((dot(x, x) < kFarthest * kFarthest) & (dot(v, v) < kFastest * kFastest));  // false for NaN
}

}  // namespace

bool FiniteGuard::validate() const { return previous.x != nullptr && position.x != nullptr && velocity.x != nullptr; }

void FiniteGuard::run(Stats& stats) const {
  run_wide(widest_vectors(), [&] {
    for (std::size_t begin = 0; begin < particle_count; begin += kLanes) {
      const std::uint32_t good = good_ones(load(ConstVec3View(position), begin), load(ConstVec3View(velocity), begin));
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
