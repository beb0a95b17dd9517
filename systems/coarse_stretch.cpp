#include "systems/coarse_stretch.h"

#include <algorithm>

#include "components/lanes.h"
#include "systems/edge_limit.h"

namespace pleat {
namespace {

PLEAT_KERNEL void move_children(const CoarseLevel& level, const Vec4* begin, Vec4* position) {
  for (std::size_t c = 0; c < level.child.size(); c += kLanes) {
    Vec3Lanes moved{};
    for (std::size_t k = 0; k < kParents; ++k) {
      const std::uint32_t* parent = level.parent[k].data() + c;
      moved += (gather(position, parent).vector - gather(begin, parent).vector) * load(level.weight[k].data() + c);
    }
    const std::uint32_t* child = level.child.data() + c;
    const Vec4Lanes at = gather(position, child);
    scatter(at.vector + moved, at.w, child, position);
  }
}

}  // namespace

bool CoarseStretch::validate() const {
  return garment != nullptr && way.x != nullptr && limit >= 0.0f && relaxation > 0.0f && relaxation < 2.0f &&
         position != nullptr && begin != nullptr && position->size() >= padded(garment->particle_count) + 2 &&
         begin->size() >= position->size();
}

void CoarseStretch::run(Stats& stats, VectorSet set) const {
  const std::uint32_t empty = garment->slots.empty_place;  // a parent of weight 0: it must be finite
  (*position)[empty] = (*position)[empty + 1] = {};
  std::copy_n(position->begin(), empty + 2, begin->begin());
  for (const CoarseLevel& level : garment->coarse) {
    run_wide(set, [&] {
      stats.edges_skipped += limit_edges(level.slots, limit, relaxation, way.from(level.way_begin), *position, set);
      move_children(level, begin->data(), position->data());
    });
  }
}

}  // namespace pleat
