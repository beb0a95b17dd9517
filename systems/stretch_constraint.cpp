#include "systems/stretch_constraint.h"

namespace pleat {

bool StretchConstraint::validate() const {
  return garment != nullptr && inverse_mass != nullptr && position.x != nullptr && limit >= 0.0f;
}

void StretchConstraint::run(Stats& stats) const {
  const std::uint32_t* first = garment->edge_particle[0].data();
  const std::uint32_t* second = garment->edge_particle[1].data();
  const float* rest_length = garment->edge_rest_length.data();
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const Vec3 d = position[j] - position[i];
    const float l = length(d), longest = (1.0f + limit) * rest_length[e];
    if (l < 1e-9f) ++stats.edges_skipped;
    const float weight = inverse_mass[i] + inverse_mass[j];
    if (!(l > longest) || l < 1e-9f || weight == 0.0f) continue;
    const Vec3 pull = d * ((l - longest) / (l * weight));
    position.add(i, pull * inverse_mass[i]);
    position.add(j, pull * -inverse_mass[j]);
  }
}

}  // namespace pleat
