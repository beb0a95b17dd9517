#include "systems/gravity.h"

namespace pleat {

bool Gravity::validate() const { return mass != nullptr && force.x != nullptr && is_finite(acceleration); }

void Gravity::run() const {
  for (std::size_t i = 0; i < particle_count; ++i) force.add(i, acceleration * mass[i]);
}

}  // namespace pleat
