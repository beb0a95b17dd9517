#include "systems/gravity.h"

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {

bool Gravity::validate() const { return mass != nullptr && force.x != nullptr && is_finite(acceleration); }

void Gravity::run() const {
  run_wide(widest_vectors(), [&] {
    const Vec3Lanes pull = all(acceleration);
    for (std::size_t i = 0; i < particle_count; i += kLanes) {
      store(load(ConstVec3View(force), i) + pull * load(mass + i), force, i);
    }
  });
}

}  // namespace pleat
