// To which side each short edge folds.
#pragma once

#include "components/fold_choice.h"
#include "components/garment.h"

namespace pleat {

/// A short edge may fold to either side of its PN curve. The curve bulges to one of them, and that is the first guess.
/// But cloth that is folded is no longer than at rest in between either: the middles of two edges of a face are half
/// of its third edge apart. So springs between the middles of the edges are asked, three times for all edges at
/// once: an edge goes to the side where the springs to its four neighbours, as they stand, and its own smaller bump
/// have less energy. Where both sides cost about the same a small move can turn the choice. The drawn side follows it
/// in time, through no fold at all, so that nothing pops.
/// Reads:  garment faces, edges and rest lengths; position (P) m; normal (N) unit
/// Writes: side (E), -1 .. 1: against, undecided or along the sum of the normals at the edge's ends; read as well, as
///         the last frame left it; choices, scratch, of which others may read the curves
/// Cost:   O(E + F), no allocation. Errors: none.
struct FoldSides {
  const Garment* garment = nullptr;
  ConstVec3View position;
  ConstVec3View normal;
  FoldChoices* choices = nullptr;
  float kept = 0.0f;      // share of the last frame's side that stays, 0 .. 1; 0 where there was no last frame
  float* side = nullptr;  // a column

  /// `kept` for a frame dt seconds after the last one.
  static float kept_after(float dt);

  bool validate() const;
  void run() const;
};

}  // namespace pleat
