// The length that an edge of the drawn surface has at rest.
#pragma once

#include "components/garment.h"

namespace pleat {

/// Fills garment.edge_rest_curve_length (E) m: the length of the PN curve over each edge of the rest shape, with the
/// normals that an unloaded cloth has there. It is longer than the rest length wherever the garment is round.
/// Throws std::bad_alloc.
void measure_rest_curves(Garment& garment);

}  // namespace pleat
