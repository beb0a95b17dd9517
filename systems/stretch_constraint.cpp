#include "systems/stretch_constraint.h"

#include "components/pull_direction.h"
#include "systems/edge_pass.h"

namespace pleat {
namespace {

constexpr float kShortest2 = 1e-18f;  // m2, of an edge that has a direction

/// Returns how many edges were too short.
PLEAT_KERNEL std::uint32_t limit_edges(const StretchConstraint& in, VectorSet set) {
  const float most = 1.0f + in.limit, relaxation = in.relaxation;
  std::uint32_t skipped = 0;
  for_each_edge(*in.garment, in.way, *in.position, set, [&](const auto& edge) {
    const auto a = edge.end(0), b = edge.end(1);
    const auto d = b.vector - a.vector;
    const auto l2 = dot(d, d), longest = most * edge.rest_length(), weight = a.w + b.w;
    const auto vanished = l2 < kShortest2;
    if (any(vanished)) skipped += count(vanished);
    const auto moves = (l2 > longest * longest) & (l2 >= kShortest2) & (weight > 0.0f);
    if (!any(moves)) return;
    const auto [way, along] = pull_direction(d, l2, edge.way());
    const auto l = sqrt(l2), yielding = moves ? weight * along : decltype(l){} + 1.0f;
    const auto pull = way * (moves ? relaxation * (l - longest) * l / yielding : decltype(l){});
    edge.put(0, a.vector + pull * a.w, a.w);
    edge.put(1, b.vector - pull * b.w, b.w);
  });
  return skipped;
}

}  // namespace

bool StretchConstraint::validate() const {
  return garment != nullptr && way.x != nullptr && limit >= 0.0f && relaxation > 0.0f && relaxation < 2.0f &&
         position != nullptr && position->size() >= padded(garment->particle_count) + 2;
}

void StretchConstraint::run(Stats& stats, VectorSet set) const {
  run_wide(set, [&] { stats.edges_skipped += limit_edges(*this, set); });
}

}  // namespace pleat
