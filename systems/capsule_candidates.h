// Which features of a cloth may touch which capsules.
//   L. Verlet, 1967: what is found within a margin stays complete until things have moved by as much.
#pragma once

#include "components/capsule_candidates.h"

namespace pleat {

/// Marks, for each capsule, the features of the cloth nearer than thickness + contact_margin + kSkin to its surface, as
/// CapsuleDetection looks at them; a face only counts near an end of the core. Marks of the same tick are left as they
/// are as long as they lack nothing: while no particle has moved against any core by more than the skin, less what
/// contact_margin has grown by, or where it was far away by more than its features were.
/// Reads:  garment edges, faces; position (predicted), previous (P) m; capsules, ascending by index
/// Writes: candidates; packed
/// Cost:   O(P capsules) where marks still hold, else O((P + E + F) capsules); no allocation.
/// Errors: none.
struct CapsuleCandidates {
  const Garment* garment = nullptr;
  ConstVec3View position;  // predicted
  ConstVec3View previous;  // when the substep began
  const CapsulePose* capsules = nullptr;
  std::uint32_t capsule_count = 0;
  float thickness = 0.0f;  // m
  bool first = true;       // substep of the tick: there are no marks yet
  CapsuleCandidateColumns* candidates = nullptr;
  Vec4* packed = nullptr;  // scratch, (P) padded

  static constexpr float kSkin = 0.02f;  // m

  bool validate() const;
  void run() const;
};

}  // namespace pleat
