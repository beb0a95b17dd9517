#include "systems/finite_guard.h"

namespace pleat {

bool FiniteGuard::validate() const { return previous.x != nullptr && position.x != nullptr && velocity.x != nullptr; }

void FiniteGuard::run(Stats& stats) const {
  constexpr float kFarthest = 1e6f, kFastest = 1e5f;
  for (std::size_t i = 0; i < particle_count; ++i) {
    const Vec3 x = position[i], v = velocity[i];
    const bool good = dot(x, x) < kFarthest * kFarthest && dot(v, v) < kFastest * kFastest;  // false for NaN
    if (good) continue;
    position.set(i, previous[i]);
    velocity.set(i, {});
    ++stats.nonfinite_restored;
  }
}

}  // namespace pleat
