// What the choice of a side for the folds works on: scratch of the system fold_sides.
#pragma once

#include "components/vec3_block.h"

namespace pleat {

/// An edge that may fold to either side of its curve.
struct FoldChoice {
  Vec3 middle, direction;  // m; unit
  float up, down;          // m, heights of the two folds, up >= 0 >= down
  float side;              // -1 .. 1: down, undecided or up
  float height;            // m, as high as the side is decided
  float bump;              // how much more energy the fold itself has down than up
  float gain;              // and the springs around it
};

/// In each of a few faces the three springs between the middles of its edges, spring k from that of edge k to that of
/// edge k + 1. Over its rest length the square of a spring's length is, with heights h and g at its two ends,
///   1 + stretch + 2 (at_first h - at_second g - both h g) + unit (h^2 + g^2)
struct FoldSprings {
  alignas(32) float stretch[3][kLanes], at_first[3][kLanes], at_second[3][kLanes], both[3][kLanes], unit[3][kLanes];
};

}  // namespace pleat
