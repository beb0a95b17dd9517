#include "systems/velocity_update.h"

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {

bool VelocityUpdate::validate() const {
  return position.x != nullptr && predicted.x != nullptr && inverse_mass != nullptr && velocity.x != nullptr &&
         dt > 0.0f;
}

void VelocityUpdate::run() const {
  const float rate = 1.0f / dt;
  run_wide(widest_vectors(), [&] {
    for (std::size_t i = 0; i < particle_count; i += kLanes) {
      const Vec3Lanes v = load(ConstVec3View(velocity), i), change = (load(position, i) - load(predicted, i)) * rate;
      store(choose(load(inverse_mass + i) != 0.0f, v + change, v), velocity, i);
    }
  });
}

}  // namespace pleat
