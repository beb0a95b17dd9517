// Tangents of the drawn surface, for normal maps and for weaves that shine along their threads.
//   E. Lengyel, "Computing tangent space basis vectors for an arbitrary mesh", 2001; weights as noted below.
#pragma once

#include "components/garment.h"
#include "components/tessellation_pattern.h"

namespace pleat {

/// The tangent of a shaded vertex points where u of the texture grows: the sum of dp/du over the drawn triangles around
/// it, each counting by its area in the texture, made square to the normal and unit. handedness * cross(normal,
/// tangent) points where v grows; it is -1 where the texture is mirrored.
/// Where the garment has no uvs, or u does not change, the tangent is the direction across the normal that is nearest
/// to the x axis (to the z axis where the normal itself is near x) and handedness is 1.
/// Reads:  garment uvs; pattern; position (V) m; normal (S) unit
/// Writes: tangent (S) unit; handedness (S)
/// Cost:   O(V), no allocation. Errors: none.
struct DrawnTangents {
  const Garment* garment = nullptr;
  const TessellationPattern* pattern = nullptr;
  ConstVec3View position;
  ConstVec3View normal;
  Vec3View tangent;
  float* handedness = nullptr;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
