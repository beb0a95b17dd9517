#include "systems/stretch_constraint.h"

#include "systems/edge_limit.h"

namespace pleat {
bool StretchConstraint::validate() const {
  return slots != nullptr && way.x != nullptr && limit >= 0.0f && relaxation > 0.0f && relaxation < 2.0f &&
         position != nullptr && position->size() >= slots->empty_place + 2;
}

void StretchConstraint::run(Stats& stats, VectorSet set) const {
  run_wide(set, [&] { stats.edges_skipped += limit_edges(*slots, limit, relaxation, way, *position, set); });
}

}  // namespace pleat
