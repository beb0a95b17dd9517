// Folds that come and go without a jump.
#pragma once

#include <cstdint>

namespace pleat {

/// Draws folds with a share of their height.
/// Writes: fold_height (E) m.  Cost: O(E), no allocation.  Errors: none.
struct FoldFade {
  std::uint32_t edge_count = 0;
  float share = 1.0f;  // 0..1
  float* fold_height = nullptr;

  bool validate() const { return fold_height != nullptr && share >= 0.0f && share <= 1.0f; }
  void run() const {
    for (std::uint32_t e = 0; e < edge_count; ++e) fold_height[e] *= share;
  }
};

}  // namespace pleat
