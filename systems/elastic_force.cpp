#include "systems/elastic_force.h"

#include <algorithm>

namespace pleat {

bool ElasticForce::validate() const {
  return garment != nullptr && position.x != nullptr && inverse_mass != nullptr && force.x != nullptr &&
         stiffness >= 0.0f && dt > 0.0f;
}

void ElasticForce::run() const {
  const std::uint32_t* first = garment->edge_particle[0].data();
  const std::uint32_t* second = garment->edge_particle[1].data();
  const float* rest_length = garment->edge_rest_length.data();
  const float bound = 0.8f / (dt * dt);
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const Vec3 d = position[j] - position[i];
    const float weight = inverse_mass[i] + inverse_mass[j];
    const float k = stiffness * weight > bound ? bound / weight : stiffness;
    const Vec3 f = d * (k * (length(d) / rest_length[e] - 1.0f));
    force.add(i, f);
    force.add(j, -f);
  }
}

}  // namespace pleat
