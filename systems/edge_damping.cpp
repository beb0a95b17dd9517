#include "systems/edge_damping.h"

#include <algorithm>

#include "components/lanes.h"

namespace pleat {
namespace {

/// Reads into the edge columns' padding.
PLEAT_KERNEL void damp(const Garment& g, float rate, Vec4Columns& packed) {
  for (std::uint32_t begin = 0; begin < g.edge_count; begin += kLanes) {
    const std::uint32_t *i = g.edge_particle[0].data() + begin, *j = g.edge_particle[1].data() + begin;
    const MotionLanes a = gather(packed.motion.data(), i), b = gather(packed.motion.data(), j);
    const Vec3Lanes d = b.position - a.position;
    const Lanes length2 = dot(d, d), weight = a.inverse_mass + b.inverse_mass;
    const LaneMask damped = (length2 >= 1e-18f) & (weight > 0.0f);
    const Lanes share = rate * dot(b.velocity - a.velocity, d) / (damped ? weight * length2 : all(1.0f));
    const Vec3Lanes f = d * (damped ? share : Lanes{});
    const std::uint32_t count = std::min(kLanes, g.edge_count - begin);
    scatter_add(f, i, count, packed.force.data());
    scatter_add(-f, j, count, packed.force.data());
  }
}

}  // namespace

bool EdgeDamping::validate() const {
  return garment != nullptr && position.x != nullptr && velocity.x != nullptr && inverse_mass != nullptr &&
         packed != nullptr && packed->holds(garment->particle_count) && force.x != nullptr && rate >= 0.0f && dt > 0.0f;
}

void EdgeDamping::run(VectorSet set) const {
  run_wide(set, [this] {
    const std::size_t count = garment->particle_count;
    pack_state(position, inverse_mass, velocity, force, count, *packed);
    damp(*garment, std::min(rate, 0.2f / dt), *packed);
    unpack(packed->force.data(), count, force);
  });
}

}  // namespace pleat
