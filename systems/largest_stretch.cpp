#include "systems/largest_stretch.h"

#include <algorithm>

namespace pleat {

bool LargestStretch::validate() const { return garment != nullptr && position.x != nullptr && inverse_mass != nullptr; }

float LargestStretch::run() const {
  float most = 0.0f;
  for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
    const std::uint32_t i = garment->edge_particle[0][e], j = garment->edge_particle[1][e];
    if (inverse_mass[i] + inverse_mass[j] == 0.0f) continue;
    most = std::max(most, length(position[j] - position[i]) / garment->edge_rest_length[e] - 1.0f);
  }
  return most;
}

}  // namespace pleat
