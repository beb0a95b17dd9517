// Normals of a triangle mesh at its particles.
//   N. Max, "Weights for Computing Vertex Normals from Facet Normals", 1999: a face counts at its corner with
//   sin(angle) / (product of the two sides there), exact on a sphere for any triangulation.
// Here the sides are those at rest: a face that collapses then loses its say smoothly, by its area.
#pragma once

#include <algorithm>
#include <array>

#include "components/lanes.h"

namespace pleat {

/// What the cross product of two sides of a face is multiplied by at its corners 0, 1, 2; 1/m^2.
/// side: rest lengths of the face's sides 0, 1, 2, m. With the mean edge length of the garment in the numerator a face
/// at rest counts about as much as a unit vector. A face of less than about 1 um counts for less, so that all stays
/// finite.
template <class T>
inline std::array<T, 3> corner_weights(const std::array<T, 3>& side, float mean_length) {
  const std::array<T, 3> square{side[0] * side[0], side[1] * side[1], side[2] * side[2]};
  const float mean_square = mean_length * mean_length, least = 1e-37f * max(mean_square, 1.0f);
  const T scale = mean_square / max(square[0] * square[1] * square[2], T{} + least);
  return {scale * square[1], scale * square[2], scale * square[0]};  // the side across from the corner cancels
}

/// What stands in for a normal that the faces around a point do not give: any fixed unit vector.
inline constexpr Vec3 kAnyNormal{0.0f, 1.0f, 0.0f};

/// Makes sums of face normals unit, or kAnyNormal where they have no direction.
inline void normalize(Vec3View v, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; i += kLanes) {
    store(normalized_or(load(v, i), all(kAnyNormal)), v, i, std::min(kLanes, count - i));
  }
}

}  // namespace pleat
