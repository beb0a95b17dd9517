#include "systems/clearance_list.h"

#include <algorithm>
#include <bit>

#include "components/lanes.h"
#include "components/wide.h"

namespace pleat {
namespace {

constexpr int kMostSweeps = 8;          // one settles planes that agree; opposed ones converge within a few
constexpr float kSettledDepth = 1e-6f;  // m behind a plane that is not worth another sweep

/// Which of eight planes have a vertex behind them, a bit each.
PLEAT_KERNEL std::uint8_t behind(const ClearancePlane* planes, ConstVec3View x) {
  const auto of_each = [&](const auto& value) {
    return Lanes{value(planes[0]), value(planes[1]), value(planes[2]), value(planes[3]),
                 value(planes[4]), value(planes[5]), value(planes[6]), value(planes[7])};
  };
  const Vec3Lanes normal{of_each([](const ClearancePlane& p) { return p.normal.x; }),
                         of_each([](const ClearancePlane& p) { return p.normal.y; }),
                         of_each([](const ClearancePlane& p) { return p.normal.z; })};
  const Lanes height = of_each([](const ClearancePlane& p) { return p.height; });
  LaneMask found{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3Lanes corner{of_each([&](const ClearancePlane& p) { return x.x[p.vertex[c]]; }),
                           of_each([&](const ClearancePlane& p) { return x.y[p.vertex[c]]; }),
                           of_each([&](const ClearancePlane& p) { return x.z[p.vertex[c]]; })};
    found |= height - dot(normal, corner) > 0.0f;
  }
  return bits(found);
}

/// Lifts what is behind the plane. How deep that was at most, m.
float lift(const ClearancePlane& plane, const Vec3View& x) {
  float deepest = 0.0f;
  for (const std::uint32_t v : plane.vertex) {
    const float depth = plane.height - dot(plane.normal, x[v]);
    if (depth <= 0.0f) continue;
    x.add(v, plane.normal * depth);
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

/// One sweep over the planes, in their order. How deep a vertex was behind one of them, m.
PLEAT_KERNEL float sweep(const ClearancePlane* planes, std::uint32_t count, const Vec3View& x) {
  float deepest = 0.0f;
  for (std::uint32_t begin = 0; begin < count; begin += kLanes) {
    const std::uint32_t end = std::min(begin + kLanes, count);
    std::uint32_t p = begin;  // up to the first with a vertex behind it eight are looked at together
    if (end - begin == kLanes) p += static_cast<std::uint32_t>(std::countr_zero(behind(planes + begin, x)));
    for (; p < end; ++p) deepest = std::max(lift(planes[p], x), deepest);
  }
  return deepest;
}

}  // namespace

void ClearanceList::settle(const Vec3View& drawn_position) const {
  run_wide(widest_vectors(), [&] {
    int left = kMostSweeps;
    while (sweep(planes, *count, drawn_position) > kSettledDepth && --left > 0) continue;
  });
  *count = 0;
}

}  // namespace pleat
