// How finely a curved surface must be cut for a picture of a given size.
//   D. Filip, R. Magedson, R. Markot, "Surface algorithms using bounds on derivatives", 1986: a chord over the n-th
//   part of a curve c(t), t = 0..1, is at most max|c''| / (8 n^2) away from it.
#pragma once

#include "components/garment.h"

namespace pleat {

/// max|c''| over all edges of the surface, m: of the PN curve, whose second derivative runs straight from -4u + 2v to
/// 2u - 4v (components/pn_edge.h), and of the fold over it, at most 24 times its height.
/// position (P) m; normal (N) unit; fold_height (E) m, or null where the surface has no folds.
float largest_bend(const Garment& garment, ConstVec3View position, ConstVec3View normal, const float* fold_height);

/// The lowest level, 1..8, whose chords stay within half a pixel of the curve; but none whose segments are on average
/// shorter than 4 pixels, for smaller triangles cost a rasteriser more than they show.
/// bend: largest_bend(); edge_length: mean at rest, m; pixels_per_metre > 0.
std::uint32_t suggested_level(float bend, float edge_length, float pixels_per_metre);

}  // namespace pleat
