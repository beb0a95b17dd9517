// Edge length control: how far the middle of each short edge is moved so that the drawn edge keeps its length.
//   M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001, section 3.3.
#pragma once

#include "components/fold_curve.h"
#include "components/garment.h"
#include "components/surface.h"

namespace pleat {

/// Chooses p' = p + h n, eq (5), for the middle p of each edge's PN curve. h = 0 where the curve is not short.
/// kPleat
///   n       across the curve's tangent in its middle, in the plane of the two normals' sum
///   target  the length of the curve at rest, missed by up to .45 % of it so that h starts smoothly: a deficit of e is
///           closed by e^2 / (e + .45 %)
///   h       on the side that fold_sides chose, lower where that is undecided. L(h) of the folded curve
///           (components/pn_edge.h) is convex; one Newton step from the closed form for a straight edge meets the
///           target to 0.5 % down to 0.3 of the length where the curve bulges to that side already; a fold against the
///           bulge is at most twice as high as one over a straight edge, and so sets in smoothly too
/// kPaper
///   n       the quadratic normal of the PN triangle; h > 0
///   target  the straight rest length. The two halves are PN curves anew, over a-p' and p'-b
///   h       by bisection from eq (6) to 0.1 % of the length, lengths measured as sums of chords
/// Reads:  garment edges and rest lengths; position (P) m; normal (N) unit; for kPleat side (E)
/// Writes: fold (E) n, unit; fold_height (E) h, m
/// Cost:   O(E), no allocation. Errors: none; where n is undefined h is 0 (kPleat) or n is an end's normal (kPaper).
struct EdgeLength {
  SurfaceMode mode = SurfaceMode::kPleat;  // kPaper or kPleat; the other modes have no folds
  const Garment* garment = nullptr;
  ConstVec3View position;
  ConstVec3View normal;
  Vec3View fold;
  float* fold_height = nullptr;
  const float* side = nullptr;        // a column, whose padding is read, as fold_sides leaves it; kPleat only
  const FoldCurve* curves = nullptr;  // as fold_sides left them, or null, for them to be made anew; kPleat only

  bool validate() const;
  void run() const;
};

}  // namespace pleat
