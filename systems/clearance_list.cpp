#include "systems/clearance_list.h"

#include <algorithm>

namespace pleat {
namespace {

constexpr int kMostSweeps = 8;          // one settles planes that agree; opposed ones converge within a few
constexpr float kSettledDepth = 1e-6f;  // m behind a plane that is not worth another sweep

}  // namespace

void ClearanceList::settle(const Vec3View& drawn_position) const {
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    float deepest = 0.0f;
    for (std::uint32_t p = 0; p < *count; ++p) {
      const ClearancePlane& plane = planes[p];
      for (const std::uint32_t v : plane.vertex) {
        const float depth = plane.height - dot(plane.normal, drawn_position[v]);
        if (depth <= 0.0f) continue;
        drawn_position.add(v, plane.normal * depth);
        deepest = std::max(deepest, depth);
      }
    }
    if (deepest <= kSettledDepth) break;
  }
  *count = 0;
}

}  // namespace pleat
