#include "systems/air_damping.h"

#include <algorithm>

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {

bool AirDamping::validate() const {
  return mass != nullptr && velocity.x != nullptr && force.x != nullptr && rate >= 0.0f && dt > 0.0f;
}

void AirDamping::run() const {
  const float safe_rate = std::min(rate, 0.5f / dt);
  run_wide(widest_vectors(), [&] {
    for (std::size_t i = 0; i < particle_count; i += kLanes) {
      const Vec3Lanes drag = load(velocity, i) * (-safe_rate * load(mass + i));
      store(load(ConstVec3View(force), i) + drag, force, i);
    }
  });
}

}  // namespace pleat
