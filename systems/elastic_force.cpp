#include "systems/elastic_force.h"

#include <algorithm>

namespace pleat {

bool ElasticForce::validate() const {
  return garment != nullptr && position.x != nullptr && inverse_mass != nullptr && force.x != nullptr &&
         law.stiffness >= 0.0f && law.buckling >= 0.0f && room > 0.0f;
}

void ElasticForce::run() const {
  const std::uint32_t* first = garment->edge_particle[0].data();
  const std::uint32_t* second = garment->edge_particle[1].data();
  const float* rest_length = garment->edge_rest_length.data();
  const std::uint32_t* edges_at = garment->edges_at.data();
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const Vec3 d = position[j] - position[i];
    const float yielding = 2.0f * std::max(inverse_mass[i] * static_cast<float>(edges_at[i]),
                                           inverse_mass[j] * static_cast<float>(edges_at[j]));
    const float l = length(d) / rest_length[e];
    const EdgeLine line = law.at(l);
    const float k = line.stiffness * yielding > room ? room / yielding : line.stiffness;
    const Vec3 f = d * (k * (l - line.rest));
    force.add(i, f);
    force.add(j, -f);
  }
}

}  // namespace pleat
