// Normals of a triangle mesh at its particles.
//   N. Max, "Weights for Computing Vertex Normals from Facet Normals", 1999: a face counts at its corner with
//   sin(angle) / (product of the two sides there), exact on a sphere for any triangulation.
// Here the sides are those at rest: a face that collapses then loses its say smoothly, by its area.
#pragma once

#include <algorithm>
#include <array>

#include "components/garment.h"

namespace pleat {

/// What the cross product of two sides of face f is multiplied by at its corners 0, 1, 2; 1/m^2. With the mean edge
/// length in the numerator a face at rest counts about as much as a unit vector.
inline std::array<float, 3> corner_weights(const Garment& g, std::uint32_t f) {
  float side2[3];
  for (int k = 0; k < 3; ++k) {
    const float l = g.edge_rest_length[g.face_edge[k][f]];
    side2[k] = l * l;
  }
  const float scale = g.mean_edge_length * g.mean_edge_length / (side2[0] * side2[1] * side2[2]);
  return {scale * side2[1], scale * side2[2], scale * side2[0]};  // the side across from the corner cancels
}

/// The doubled area of face f times its unit normal, m^2.
inline Vec3 face_cross(const Garment& g, std::uint32_t f, ConstVec3View position) {
  const Vec3 a = position[g.face_particle[0][f]];
  return cross(position[g.face_particle[1][f]] - a, position[g.face_particle[2][f]] - a);
}

/// What stands in for a normal that the faces around a point do not give: any fixed unit vector.
inline constexpr Vec3 kAnyNormal{0.0f, 1.0f, 0.0f};

inline void clear(Vec3View v, std::size_t count) {
  std::fill(v.x, v.x + count, 0.0f);
  std::fill(v.y, v.y + count, 0.0f);
  std::fill(v.z, v.z + count, 0.0f);
}

/// Makes sums of face normals unit, or kAnyNormal where they have no direction.
inline void normalize(Vec3View v, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const float l = length(v[i]);
    const bool good = l > 1e-12f;
    const float scale = 1.0f / (good ? l : 1.0f);
    const Vec3 unit = v[i] * scale;
    v.x[i] = good ? unit.x : kAnyNormal.x;
    v.y[i] = good ? unit.y : kAnyNormal.y;
    v.z[i] = good ? unit.z : kAnyNormal.z;
  }
}

}  // namespace pleat
