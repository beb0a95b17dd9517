#pragma once

#include <cstdint>
#include <vector>

#include "bench/validation/rig.h"
#include "engine/pleat.h"

namespace pleat::bench {

/// The edges of a rig's garment, as the library made them.
class Edges {
 public:
  Edges(const pleat_api& api, const Rig& rig);
  /// Largest elongation of an edge as of the rig's last step, fraction. NaN where a position is not finite.
  double largest_strain(const Rig& rig) const;

 private:
  std::vector<uint32_t> ends_;
  std::vector<float> rest_lengths_;  // m
};

}  // namespace pleat::bench
