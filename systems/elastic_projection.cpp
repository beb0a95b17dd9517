#include "systems/elastic_projection.h"

namespace pleat {

bool ElasticProjection::validate() const {
  return garment != nullptr && inverse_mass != nullptr && position.x != nullptr && law.stiffness > 0.0f &&
         law.buckling >= 0.0f && dt > 0.0f;
}

void ElasticProjection::run() const {
  const std::uint32_t* first = garment->edge_particle[0].data();
  const std::uint32_t* second = garment->edge_particle[1].data();
  const float* rest_length = garment->edge_rest_length.data();
  const EdgeLine straight = law.straight(), buckled = law.buckled();
  const float soft = 1.0f / (straight.stiffness * dt * dt), softer = 1.0f / (buckled.stiffness * dt * dt);  // kg
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const float wi = inverse_mass[i], wj = inverse_mass[j];
    const Vec3 d = position[j] - position[i];
    const float l = length(d) / rest_length[e], yielding = (wi + wj) * l;
    float share = (l - straight.rest) / (soft + yielding);
    if (law.buckles(l - share * yielding)) share = (l - buckled.rest) / (softer + yielding);
    const Vec3 pull = d * share;
    position.add(i, pull * wi);
    position.add(j, pull * -wj);
  }
}

}  // namespace pleat
