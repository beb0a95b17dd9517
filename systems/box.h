// Axis-aligned boxes for culling.
#pragma once

#include <algorithm>

#include "components/lanes.h"
#include "components/wide.h"

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
  Box moved(const Vec3& by) const { return {low + by, high + by}; }
  Box grown(float by) const { return {low - Vec3{by, by, by}, high + Vec3{by, by, by}}; }
  bool overlaps(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z &&
           b.low.z <= high.z;
  }
  /// Not what is not finite.
  bool holds(const Box& b) const {
    return low.x <= b.low.x && b.high.x <= high.x && low.y <= b.low.y && b.high.y <= high.y && low.z <= b.low.z &&
           b.high.z <= high.z;
  }
  /// Of a point, m2; 0 inside.
  float distance2(const Vec3& p) const {
    const Vec3 d{std::max({low.x - p.x, 0.0f, p.x - high.x}), std::max({low.y - p.y, 0.0f, p.y - high.y}),
                 std::max({low.z - p.z, 0.0f, p.z - high.z})};
    return dot(d, d);
  }
};

/// The box around points [0, count), at least eight, which the last eight overlap with those before.
PLEAT_KERNEL Box box_of_lanes(ConstVec3View points, std::size_t count) {
  Box lows, highs;
  Vec3Lanes low = all(lows.low), high = all(highs.high);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Vec3Lanes p = load(points, std::min(i, count - kLanes));
    low = {min(p.x, low.x), min(p.y, low.y), min(p.z, low.z)};
    high = {max(p.x, high.x), max(p.y, high.y), max(p.z, high.z)};
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    lows.include({low.x[k], low.y[k], low.z[k]});
    highs.include({high.x[k], high.y[k], high.z[k]});
  }
  return {lows.low, highs.high};
}

/// The box around points [0, count).
inline Box box_of(ConstVec3View points, std::size_t count) {
  Box box;
  if (count >= kLanes) {
    run_wide(widest_vectors(), [&] { box = box_of_lanes(points, count); });
  } else {
    for (std::size_t i = 0; i < count; ++i) box.include(points[i]);
  }
  return box;
}

}  // namespace pleat
