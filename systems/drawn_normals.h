// Shading normals of the drawn surface.
#pragma once

#include "components/tessellation_pattern.h"
#include "components/vec4.h"

namespace pleat {

/// The normal of a shaded vertex is the sum of the cross products of the drawn triangles around it, so each counts by
/// its area, made unit; across a crease nothing is summed. The quadratic normals of PN triangles are not used: they
/// exaggerate folds and know nothing of them.
/// Reads:  pattern triangles; position (V) m
/// Writes: normal (S) unit, one a shaded vertex; sum, scratch
/// Cost:   O(V), no allocation.
/// Errors: none; where the triangles cancel or have no area the normal is some fixed unit vector.
struct DrawnNormals {
  const TessellationPattern* pattern = nullptr;
  ConstVec3View position;
  Vec4* sum = nullptr;  // (S) m2, and kLanes more
  Vec3View normal;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
