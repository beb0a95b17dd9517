#include "systems/edge_damping.h"

#include <algorithm>

namespace pleat {

bool EdgeDamping::validate() const {
  return garment != nullptr && position.x != nullptr && velocity.x != nullptr && inverse_mass != nullptr &&
         force.x != nullptr && rate >= 0.0f && dt > 0.0f;
}

void EdgeDamping::run() const {
  const std::uint32_t* first = garment->edge_particle[0].data();
  const std::uint32_t* second = garment->edge_particle[1].data();
  const float safe_rate = std::min(rate, 0.2f / dt);
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const Vec3 d = position[j] - position[i];
    const float length_squared = dot(d, d);
    const float weight = inverse_mass[i] + inverse_mass[j];
    if (length_squared < 1e-18f || weight == 0.0f) continue;
    const Vec3 f = d * (safe_rate * dot(velocity[j] - velocity[i], d) / (weight * length_squared));
    force.add(i, f);
    force.add(j, -f);
  }
}

}  // namespace pleat
