// Which features of a cloth may touch which capsules.
//   L. Verlet, 1967: what is found within a margin stays complete until things have moved by as much.
#pragma once

#include "components/capsule_candidates.h"

namespace pleat {

/// Lists, for each capsule, the features of the cloth nearer than thickness + capsule_margin + kSkin to its surface, as
/// CapsuleDetection looks at them; a face only counts near an end of the core. Lists are left as they are as long as
/// they lack nothing: while no particle has moved against a core by more than the skin, less what capsule_margin has
/// grown by, or by more than all its features that are not listed are away, as far as kFar. That holds from tick to
/// tick too, where a worker has no other cloth.
/// Reads:  garment edges, faces; position (predicted) (P) m, packed too; capsules, ascending by index
/// Writes: candidates
/// Cost:   O(P capsules) where lists still hold, else O((P + E + F) capsules); no allocation.
/// Errors: none.
struct CapsuleCandidates {
  const Garment* garment = nullptr;
  ConstVec3View position;        // predicted
  const Vec4* packed = nullptr;  // the same
  const CapsulePose* capsules = nullptr;
  std::uint32_t capsule_count = 0;
  float thickness = 0.0f;  // m
  float margin = 0.0f;     // m, capsule_margin
  CapsuleCandidateColumns* candidates = nullptr;

  static constexpr float kSkin = 0.02f, kFar = 0.06f;  // m

  bool validate() const;
  void run() const;
};

}  // namespace pleat
