#include "systems/stretch_constraint.h"

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {
namespace {

/// Returns how many edges were too short to have a direction.
PLEAT_KERNEL std::uint32_t limit_edges(const StretchConstraint& in) {
  const Garment& g = *in.garment;
  const std::uint32_t *first = g.edge_particle[0].data(), *second = g.edge_particle[1].data();
  const float* rest_length = g.edge_rest_length.data();
  const float most = 1.0f + in.limit;
  std::uint32_t skipped = 0;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    Vec4 &a = in.packed[first[e]], &b = in.packed[second[e]];
    const Vec3 d{b.x - a.x, b.y - a.y, b.z - a.z};
    const float l2 = dot(d, d), longest = most * rest_length[e];
    if (l2 < 1e-18f) ++skipped;
    if (!(l2 > longest * longest) || l2 < 1e-18f) continue;
    const float wa = a.w, wb = b.w, weight = wa + wb;
    if (weight == 0.0f) continue;
    const float l = std::sqrt(l2);
    const Vec3 pull = d * (in.relaxation * (l - longest) / (l * weight));
    a = {a.x + pull.x * wa, a.y + pull.y * wa, a.z + pull.z * wa, wa};
    b = {b.x - pull.x * wb, b.y - pull.y * wb, b.z - pull.z * wb, wb};
  }
  return skipped;
}

}  // namespace

bool StretchConstraint::validate() const {
  return garment != nullptr && inverse_mass != nullptr && position.x != nullptr && limit >= 0.0f && relaxation > 0.0f &&
         relaxation < 2.0f && packed != nullptr;
}

void StretchConstraint::run(Stats& stats) const {
  run_wide(widest_vectors(), [&] {
    pack(position, inverse_mass, garment->particle_count, packed);
    stats.edges_skipped += limit_edges(*this);
    unpack(packed, garment->particle_count, position);
  });
}

}  // namespace pleat
