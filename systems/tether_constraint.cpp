#include "systems/tether_constraint.h"

#include "components/lanes.h"

namespace pleat {
namespace {

PLEAT_KERNEL void pull_back(const TetherConstraint& in) {
  const Garment& g = *in.garment;
  for (std::size_t t = 0; t < g.tether_length.size(); t += kLanes) {
    const std::uint32_t* particle = g.tether_particle.data() + t;
    const Vec4Lanes at = gather(in.position, particle);
    const Vec3Lanes d = gather(in.position, g.tether_pin.data() + t).vector - at.vector;
    const Lanes l = length(d), longest = (1.0f + in.limit) * load(g.tether_length.data() + t);
    const LaneMask far = l > longest;
    if (!any(far)) continue;
    const Lanes share = far ? 1.0f - longest / (far ? l : longest) : Lanes{};
    scatter(at.vector + d * share, at.w, particle, in.position);
  }
}

}  // namespace

bool TetherConstraint::validate() const { return garment != nullptr && position != nullptr && limit >= 0.0f; }

void TetherConstraint::run(VectorSet set) const {
  run_wide(set, [this] { pull_back(*this); });
}

}  // namespace pleat
