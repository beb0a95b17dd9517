// Numbers of the drawn surface in 16 bits, as GPUs read them: UNORM and SNORM of Vulkan, Direct3D and Metal.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "components/vec3.h"

namespace pleat {

/// Places in a box as three uint16 from corner to corner: low + u / 65535 (high - low). They are off by at most half a
/// step, (high - low) / 131070 on each axis, and by what single precision rounds on the way.
class UnormBox {
 public:
  UnormBox(const Vec3& low, const Vec3& high)
      : low_(low), steps_per_metre_{density(high.x - low.x), density(high.y - low.y), density(high.z - low.z)} {}
  /// p must be in the box.
  std::array<std::uint16_t, 3> pack(const Vec3& p) const {
    const Vec3 from_low = p - low_;
    return {nearest(from_low.x * steps_per_metre_.x), nearest(from_low.y * steps_per_metre_.y),
            nearest(from_low.z * steps_per_metre_.z)};
  }

 private:
  static constexpr float kThinnest = 1e-20f;  // m; a box thinner than that is flat, and its places are its low corner's
  static float density(float extent) { return extent > kThinnest ? 65535.0f / extent : 0.0f; }
  static std::uint16_t nearest(float u) { return static_cast<std::uint16_t>(u + 0.5f); }

  Vec3 low_, steps_per_metre_;
};

/// v within -1..1 as s / 32767: off by at most half a step, so that a unit vector of three turns by at most
/// sqrt(3) / 65534, .0015 degrees.
inline std::int16_t snorm16(float v) { return static_cast<std::int16_t>(v * 32767.0f + std::copysign(0.5f, v)); }

}  // namespace pleat
