// Which side of a body a drawn triangle has to stay on.
#pragma once

#include <algorithm>
#include <cstdint>

#include "components/vec3.h"

namespace pleat {

/// All three drawn vertices have to satisfy  normal . x >= height.
struct ClearancePlane {
  Vec3 normal;   // out of the body, unit
  float height;  // m
  std::uint32_t vertex[3];
};

/// A triangle of a mesh body near the coarse face at hand.
struct NearTriangle {
  Vec3 corner[3];      // m
  Vec3 normal;         // unit, or zero
  Vec3 aside[3];       // unit, in its plane, square to edge k and out of it; or zero
  float above, below;  // m, from the face's plane to the nearest of its corners; zero where it is not on that side
  std::uint32_t index;

  /// Less than the distance to a triangle pqr, or equal: how far one of five planes through the body's corners keeps
  /// the two apart, m; at least 0.
  float apart_from(const Vec3& p, const Vec3& q, const Vec3& r) const {
    const auto least = [&](const Vec3& from, const Vec3& axis) {
      return std::min(std::min(dot(p - from, axis), dot(q - from, axis)), dot(r - from, axis));
    };
    float apart = std::max(least(corner[0], normal), least(corner[0], -normal));
    for (int k = 0; k < 3; ++k) apart = std::max(apart, least(corner[k], aside[k]));
    return std::max(apart, 0.0f);
  }
};

}  // namespace pleat
