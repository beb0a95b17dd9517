// Shading normals of the drawn surface.
#pragma once

#include "components/tessellation_pattern.h"

namespace pleat {

/// The normal of a drawn vertex is the sum of the cross products of the drawn triangles around it, so each counts by
/// its area, made unit. The quadratic normals of PN triangles are not used: they exaggerate folds and know nothing of
/// them. Reads:  pattern triangles; position (V) m Writes: normal (V) unit Cost:   O(V), no allocation. Errors: none;
/// where the triangles cancel or have no area the normal is some fixed unit
///         vector.
struct DrawnNormals {
  const TessellationPattern* pattern = nullptr;
  ConstVec3View position;
  Vec3View normal;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
