// The curves over eight neighbouring edges, and which way these fold: what the systems of the drawn surface share.
#pragma once

#include "components/edge_block.h"

namespace pleat {

struct FoldCurve {
  PnEdgeT<Lanes> curve;
  FoldDirection<Lanes> fold;

  FoldCurve() = default;
  explicit PLEAT_KERNEL FoldCurve(const EdgeBlock& edges)
      : curve(edges.curve()), fold(fold_direction(curve.middle_tangent(), edges.na + edges.nb)) {}
};

}  // namespace pleat
