#include "components/suggested_level.h"

#include <algorithm>
#include <cmath>

#include "components/pn_edge.h"
#include "components/tessellation_pattern.h"

namespace pleat {

float largest_bend(const Garment& g, ConstVec3View position, ConstVec3View normal, const float* fold_height) {
  constexpr float kBendOfFold = 24.0f;
  float largest = 0.0f;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const PnEdge c(position[g.edge_particle[0][e]], position[g.edge_particle[1][e]], normal[g.edge_normal[0][e]],
                   normal[g.edge_normal[1][e]]);
    float bend = std::max(length(c.v * 2.0f - c.u * 4.0f), length(c.u * 2.0f - c.v * 4.0f));
    if (fold_height != nullptr) bend += kBendOfFold * std::abs(fold_height[e]);
    largest = std::max(largest, bend);
  }
  return largest;
}

std::uint32_t suggested_level(float bend, float edge_length, float pixels_per_metre) {
  constexpr float kChordError = 0.5f, kShortestSegment = 4.0f;  // pixels
  const float needed = std::ceil(0.5f * std::sqrt(bend * pixels_per_metre / (8.0f * kChordError)));
  const float sensible = std::floor(0.5f * edge_length * pixels_per_metre / kShortestSegment);
  return static_cast<std::uint32_t>(
      std::clamp(std::min(needed, sensible), 1.0f, static_cast<float>(kMaxTessellationLevel)));
}

}  // namespace pleat
