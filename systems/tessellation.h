// The drawn surface: a point on the curved face for every vertex of the tessellation pattern.
//   M. Oshita, A. Makinouchi, "Real-time Cloth Simulation with Sparse Particles and Curved Faces", 2001,
//   sections 3.1, 3.3.
#pragma once

#include "components/fold_curve.h"
#include "components/surface.h"
#include "components/tessellation_pattern.h"

namespace pleat {

/// Drawn vertices at particles are the particles; those on an edge depend on the edge's data alone, so that the faces
/// on both sides share them; those inside are each face's own.
///   kFlat   the flat triangles
///   kPn     PN triangles (components/pn_triangle.h)
///   kPaper  each face in four: PN triangles over its corners and its edges' moved middles
///   kPleat  the PN triangle plus the folds h n of its three edges, faded out over the four parts. A face without
///           folds is drawn as by kPn, bit for bit
///   kPhong, kSpherigon  the flat triangles lifted point by point (components/projected_triangle.h)
///   kArcPn  PN triangles with the tangents of circular arcs (components/arc_pn.h)
/// Creases part the slopes of kPn, kPleat and kArcPn; the other modes know them in the shading only.
/// Reads:  garment faces and edges; pattern; position (P) m; normal (N) unit, not for kFlat; fold (E) unit and
///         fold_height (E) m, for kPaper and kPleat only
/// Writes: drawn_position (V) m; bulge (F) m, how far a face's vertices are from its flat triangle at most, up to
///         rounding
/// Cost:   O(V), no allocation. Errors: none.
struct Tessellation {
  SurfaceMode mode = SurfaceMode::kPleat;
  const Garment* garment = nullptr;
  const TessellationPattern* pattern = nullptr;
  ConstVec3View position;
  ConstVec3View normal;
  ConstVec3View fold;
  const float* fold_height = nullptr;
  Vec3View drawn_position;
  const FoldCurve* curves = nullptr;  // as fold_sides left them, or null, for them to be made anew; kPleat only
  float* bulge = nullptr;             // a column, or null; only for modes that tell it

  static bool tells_bulge(SurfaceMode mode);
  bool validate() const;
  void run() const;
};

}  // namespace pleat
