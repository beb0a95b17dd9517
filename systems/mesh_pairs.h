// Which of the pairs of features of a cloth and of a mesh body come near each other in a substep, eight side by side:
// most do not. Who does is measured by MeshDetection.
#pragma once

#include <span>

#include "components/garment.h"
#include "components/mesh_candidates.h"

namespace pleat {

/// Where cloth and body are at the end of the substep.
struct MeshPairs {
  const Garment& garment;
  const Vec4* position;            // (P) m
  const Vec4* body;                // m, by vertices
  const std::uint32_t* triangles;  // three vertices each
  float reach;                     // m

  /// The distance to the triangle, squared, m2, right to kDistanceError m where its sides are not longer than a metre.
  void measure(std::span<const MeshParticlePair> pairs, float* distance2) const;
  static constexpr float kDistanceError = 5e-4f;

  /// A bit for each pair, the first one's lowest: the vertex lies within reach over the face, or beside one of its
  /// edges.
  void find_near(std::span<const MeshVertexPair> pairs, std::uint8_t* near) const;
  /// The same: seen along their common normal the edges cross, and are within reach.
  void find_near(std::span<const MeshEdgePair> pairs, std::uint8_t* near) const;
  /// The same of such pairs: the ridge stands out towards the edge.
  void find_met(std::span<const MeshEdgePair> pairs, std::uint8_t* met) const;
};

}  // namespace pleat
