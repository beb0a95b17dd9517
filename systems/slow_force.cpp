#include "systems/slow_force.h"

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {

bool SlowForce::validate() const { return slow.x != nullptr && force.x != nullptr; }

void SlowForce::run() const {
  run_wide(widest_vectors(), [&] {
    for (std::size_t i = 0; i < particle_count; i += kLanes) {
      store(load(ConstVec3View(force), i) + load(slow, i), force, i);
    }
  });
}

}  // namespace pleat
