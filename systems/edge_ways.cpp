#include "systems/edge_ways.h"

#include "components/lanes.h"

namespace pleat {

bool EdgeWays::validate() const {
  return garment != nullptr && previous.x != nullptr && packed != nullptr && packed->holds(garment->particle_count) &&
         way != nullptr;
}

void EdgeWays::run(VectorSet set) const {
  run_wide(set, [this] {
    Vec4* place = packed->position.data();
    pack(previous, nullptr, garment->particle_count, place);
    for (std::uint32_t e = 0; e < garment->edge_count; e += kLanes) {
      const Vec4Lanes from = gather(place, garment->edge_particle[0].data() + e);
      const Vec4Lanes to = gather(place, garment->edge_particle[1].data() + e);
      const Vec3Lanes d = to.vector - from.vector;
      pack(d, dot(d, d), way + e);
    }
  });
}

}  // namespace pleat
