#include "systems/stretch_constraint.h"

namespace pleat {

bool StretchConstraint::validate() const {
  return garment != nullptr && inverse_mass != nullptr && position.x != nullptr && limit >= 0.0f && packed != nullptr;
}

void StretchConstraint::run(Stats& stats) const {
  const std::uint32_t* first = garment->edge_particle[0].data();
  const std::uint32_t* second = garment->edge_particle[1].data();
  const float* rest_length = garment->edge_rest_length.data();
  const std::uint32_t count = garment->particle_count;
  for (std::uint32_t i = 0; i < count; ++i) {
    packed[i] = {position.x[i], position.y[i], position.z[i], inverse_mass[i]};
  }
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    PackedParticle &a = packed[first[e]], &b = packed[second[e]];
    const Vec3 d{b.x - a.x, b.y - a.y, b.z - a.z};
    const float l2 = dot(d, d), longest = (1.0f + limit) * rest_length[e];
    if (l2 < 1e-18f) ++stats.edges_skipped;
    if (!(l2 > longest * longest) || l2 < 1e-18f) continue;
    const float wa = a.inverse_mass, wb = b.inverse_mass, weight = wa + wb;
    if (weight == 0.0f) continue;
    const float l = std::sqrt(l2);
    const Vec3 pull = d * ((l - longest) / (l * weight));
    a = {a.x + pull.x * wa, a.y + pull.y * wa, a.z + pull.z * wa, wa};
    b = {b.x - pull.x * wb, b.y - pull.y * wb, b.z - pull.z * wb, wb};
  }
  for (std::uint32_t i = 0; i < count; ++i) position.set(i, {packed[i].x, packed[i].y, packed[i].z});
}

}  // namespace pleat
