#include "systems/edge_ways.h"

#include "components/lanes.h"

namespace pleat {
namespace {

PLEAT_KERNEL void find_ways(const Vec4* place, const EdgeSlots& slots, const Vec3View& way) {
  for (std::uint32_t s = 0; s < slots.count; s += kLanes) {
    const Vec4Lanes from = gather(place, slots.place[0].data() + s);
    const Vec4Lanes to = gather(place, slots.place[1].data() + s);
    store(to.vector - from.vector, way, s);
  }
}

}  // namespace

bool EdgeWays::validate() const {
  return garment != nullptr && previous != nullptr && previous->size() > garment->slots.empty_place + 1 &&
         way.x != nullptr;
}

void EdgeWays::run(VectorSet set) const {
  run_wide(set, [this] {
    Vec4* place = previous->data();
    const std::uint32_t empty = garment->slots.empty_place;
    place[empty] = place[empty + 1] = {};
    find_ways(place, garment->slots, way);
    for (const CoarseLevel& level : garment->coarse) find_ways(place, level.slots, way.from(level.way_begin));
  });
}

}  // namespace pleat
