#include "systems/edge_ways.h"

#include "components/lanes.h"

namespace pleat {

bool EdgeWays::validate() const {
  return garment != nullptr && previous.x != nullptr && packed != nullptr && packed->holds(garment->particle_count) &&
         way.x != nullptr;
}

void EdgeWays::run(VectorSet set) const {
  run_wide(set, [this] {
    Vec4* place = packed->position.data();
    pack(previous, nullptr, garment->particle_count, place);
    place[garment->empty_place()] = place[garment->empty_place() + 1] = {};
    for (std::uint32_t s = 0; s < garment->slot_count; s += kLanes) {
      const Vec4Lanes from = gather(place, garment->slot_particle[0].data() + s);
      const Vec4Lanes to = gather(place, garment->slot_particle[1].data() + s);
      store(to.vector - from.vector, way, s);
    }
  });
}

}  // namespace pleat
