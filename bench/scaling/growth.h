#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/pleat.h"

namespace pleat::bench {

/// A scene of one size over half a second.
struct SizeCost {
  uint32_t size;              ///< the scene's N
  uint64_t particles;         ///< of all cloths
  double us = 0.0;            ///< processor time of a frame: the mean of each frame's least over the rounds
  uint32_t substeps = 0;      ///< of the last frame
  uint64_t passes = 0;        ///< of the strain limit over a cloth in the last frame
  double longest_edge = 0.0;  ///< elongation beyond rest in the last frame, percent

  double ns_a_particle() const { return 1e3 * us / double(particles); }
};

/// What a frame of a scene costs as the scene grows.
struct Growth {
  std::string scene;
  std::vector<SizeCost> sizes;

  const SizeCost& middle() const { return sizes[sizes.size() / 2]; }
  /// Time a particle over that at the middle of the range.
  double ratio(const SizeCost& cost) const { return cost.ns_a_particle() / middle().ns_a_particle(); }
};

/// Runs all sizes in turn, `rounds` times. `progress` is called after each run.
/// Throws InputError where the scene has no such size.
Growth measure_growth(const pleat_api& api, const std::string& scene, const std::vector<uint32_t>& sizes,
                      uint32_t rounds, const std::function<void()>& progress);

}  // namespace pleat::bench
