// The skirt of the workloads: 66 particles in five rings, 108 triangles.
#pragma once

#include <array>

#include "components/shapes.h"

namespace pleat {

inline constexpr std::array<std::uint32_t, 5> kSkirtRings{8, 12, 14, 16, 16};

inline Mesh make_skirt() {
  std::array<Ring, 5> rings;
  for (std::size_t r = 0; r < 5; ++r) {
    const float k = static_cast<float>(r);
    rings[r] = {kSkirtRings[r], 0.14f + 0.0525f * k, 1.05f - 0.125f * k};
  }
  return make_rings(rings);
}

}  // namespace pleat
