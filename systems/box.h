// Axis-aligned boxes for culling.
#pragma once

#include <algorithm>

#include "components/column.h"

namespace pleat {

/// The points between two corners, m. A new one is empty.
struct Box {
  Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Box with(Box b) const {
    b.include(low);
    b.include(high);
    return b;
  }
  Box grown(float by) const { return {low - Vec3{by, by, by}, high + Vec3{by, by, by}}; }
  bool overlaps(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z &&
           b.low.z <= high.z;
  }
  /// Of a point, m2; 0 inside.
  float distance2(const Vec3& p) const {
    const Vec3 d{std::max({low.x - p.x, 0.0f, p.x - high.x}), std::max({low.y - p.y, 0.0f, p.y - high.y}),
                 std::max({low.z - p.z, 0.0f, p.z - high.z})};
    return dot(d, d);
  }
};

/// The box around points [0, count).
inline Box box_of(ConstVec3View points, std::size_t count) {
  Box box;
  for (std::size_t i = 0; i < count; ++i) box.include(points[i]);
  return box;
}

}  // namespace pleat
