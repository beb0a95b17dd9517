// The pass over edges that limits how long they become; see stretch_constraint.h.
#pragma once

#include "components/pull_direction.h"
#include "systems/edge_pass.h"

namespace pleat {

/// Returns how many edges were too short to have a direction.
PLEAT_KERNEL std::uint32_t limit_edges(const EdgeSlots& slots, float limit, float relaxation, ConstVec3View way,
                                       Column<Vec4>& position, VectorSet set) {
  constexpr float kShortest2 = 1e-18f;  // m2
  const float most = 1.0f + limit;
  std::uint32_t skipped = 0;
  for_each_edge(slots, way, position, set, [&](const auto& edge) PLEAT_KERNEL_LAMBDA {
    const auto a = edge.end(0), b = edge.end(1);
    const auto d = b.vector - a.vector;
    const auto l2 = dot(d, d), longest = most * edge.rest_length(), weight = a.w + b.w;
    const auto vanished = l2 < kShortest2;
    if (any(vanished)) skipped += count(vanished);
    const auto moves = (l2 > longest * longest) & (l2 >= kShortest2) & (weight > 0.0f);
    if (!any(moves)) return;
    const auto [pull_way, along] = pull_direction(d, l2, edge.way());
    const auto l = sqrt(l2), yielding = moves ? weight * along : decltype(l){} + 1.0f;
    const auto pull = pull_way * (moves ? relaxation * (l - longest) * l / yielding : decltype(l){});
    edge.put(0, a.vector + pull * a.w, a.w);
    edge.put(1, b.vector - pull * b.w, b.w);
  });
  return skipped;
}

}  // namespace pleat
