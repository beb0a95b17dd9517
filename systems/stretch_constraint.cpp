#include "systems/stretch_constraint.h"

#include "components/lanes.h"
#include "components/pull_direction.h"
#include "components/wide.h"

namespace pleat {
namespace {

/// Returns how many edges were too short to have a direction.
PLEAT_KERNEL std::uint32_t limit_edges(const StretchConstraint& in) {
  const Garment& g = *in.garment;
  const std::uint32_t *first = g.edge_particle[0].data(), *second = g.edge_particle[1].data();
  const float* rest_length = g.edge_rest_length.data();
  const std::uint32_t count = g.edge_count;
  const float most = 1.0f + in.limit, relaxation = in.relaxation;
  const Vec4* ways = in.way;
  Vec4* packed = in.packed->position.data();
  std::uint32_t skipped = 0;
  for (std::uint32_t e = 0; e < count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const Four a = load_four(packed[i]), b = load_four(packed[j]), d = way_between(a, b);
    const float l2 = dot(d, d), longest = most * rest_length[e];
    if (l2 < 1e-18f) ++skipped;
    if (!(l2 > longest * longest) || l2 < 1e-18f) continue;
    const float wa = a[3], wb = b[3], weight = wa + wb;
    if (weight == 0.0f) continue;
    const auto [way, along] = pull_direction(d, l2, load_four(ways[e]));
    const float l = std::sqrt(l2);
    const Four pull = way * (relaxation * (l - longest) * l / (weight * along));
    store(a + pull * wa, packed[i]);
    store(b - pull * wb, packed[j]);
  }
  return skipped;
}

}  // namespace

bool StretchConstraint::validate() const {
  return garment != nullptr && inverse_mass != nullptr && way != nullptr && position.x != nullptr && limit >= 0.0f &&
         relaxation > 0.0f && relaxation < 2.0f && packed != nullptr && packed->holds(garment->particle_count);
}

void StretchConstraint::run(Stats& stats) const {
  run_wide(widest_vectors(), [&] {
    pack(position, inverse_mass, garment->particle_count, packed->position.data());
    stats.edges_skipped += limit_edges(*this);
    unpack(packed->position.data(), garment->particle_count, position);
  });
}

}  // namespace pleat
