// What the choice of a side for the folds works on: scratch of the system fold_sides.
#pragma once

#include "components/fold_curve.h"

namespace pleat {

/// In each of a few faces the three springs between the middles of its edges, spring k from that of edge k to that of
/// edge k + 1. Over its rest length the square of a spring's length is, with heights h and g at its two ends,
///   1 + stretch + 2 (at_first h - at_second g - both h g) + unit (h^2 + g^2)
struct FoldSprings {
  Lanes stretch[3], at_first[3], at_second[3], both[3], unit[3];
  Lanes up[3], down[3];  // m, heights of the folds of its three edges
};

/// Edges that may fold to either side of their curves, and the springs between them.
struct FoldChoices {
  Column<FoldCurve> curves;        // (E / kLanes, rounded up)
  Column<Vec4> middle, direction;  // (E) m and, w, m of rest length; unit
  Column<float> up, down;          // (E) m, heights of the two folds, up >= 0 >= down
  Column<float> side;              // (E) -1 .. 1: down, undecided or up
  Column<float> height;            // (E) m, as high as the side is decided
  Column<float> bump;              // (E) how much more energy the fold itself has down than up
  Column<float> gain;              // (E) and the springs around it
  Column<FoldSprings> springs;     // (F / kLanes, rounded up)

  explicit FoldChoices(std::pmr::memory_resource* m)
      : curves(m), middle(m), direction(m), up(m), down(m), side(m), height(m), bump(m), gain(m), springs(m) {}
  void make_room(std::size_t edges, std::size_t faces) {
    at_least(curves, (edges + kLanes - 1) / kLanes), at_least(middle, edges), at_least(direction, edges);
    for (Column<float>* c : {&up, &down, &side, &height, &bump, &gain}) at_least(*c, edges);
    at_least(springs, (faces + kLanes - 1) / kLanes);
  }
  bool holds(std::size_t edges, std::size_t faces) const {
    return gain.size() >= edges && springs.size() * kLanes >= faces;
  }
};

}  // namespace pleat
