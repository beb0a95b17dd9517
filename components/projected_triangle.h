// Curved triangles made by lifting the points of the flat one, from its corners' normals.
//   phong      T. Boubekeur, M. Alexa, "Phong Tessellation", 2008
//   spherigon  P. Volino, N. Magnenat-Thalmann, "The SPHERIGON: a simple polygon patch for smoothing quickly your
//              polygonal meshes", 1998; the corners' spheres are blended by the squares of the barycentrics
// A corner of weight 0 has no say, so on a side the point depends on that side's ends alone.
#pragma once

#include <cstddef>

#include "components/lanes.h"

namespace pleat {

/// corner: m; normal: unit; weight: barycentrics. The point p is drawn 3/4 of the way to the blend of its projections
/// on the corners' tangent planes.
template <class T>
inline Vec3T<T> phong_point(const Vec3T<T> (&corner)[3], const Vec3T<T> (&normal)[3], const float (&weight)[3]) {
  constexpr float kShape = 0.75f;
  const Vec3T<T> p = corner[0] * weight[0] + corner[1] * weight[1] + corner[2] * weight[2];
  Vec3T<T> point = p;
  for (std::size_t k = 0; k < 3; ++k) point -= normal[k] * (kShape * weight[k] * dot(p - corner[k], normal[k]));
  return point;
}

/// The same arguments. With each corner, p and the blended normal N there make a circle; p is moved along N to the
/// blend of where it meets them. Exact on spheres. Where N turns away from a corner's by more than 120 degrees the
/// circle is bounded.
template <class T>
inline Vec3T<T> spherigon_point(const Vec3T<T> (&corner)[3], const Vec3T<T> (&normal)[3], const float (&weight)[3]) {
  const Vec3T<T> p = corner[0] * weight[0] + corner[1] * weight[1] + corner[2] * weight[2];
  const Vec3T<T> sum = normal[0] * weight[0] + normal[1] * weight[1] + normal[2] * weight[2];
  const Vec3T<T> n = sum * (1.0f / sqrt(dot(sum, sum) + 1e-20f));
  T height{};
  float shares = 0.0f;
  for (std::size_t k = 0; k < 3; ++k) {
    const float share = weight[k] * weight[k];
    height += share * dot(corner[k] - p, normal[k] + n) / max(1.0f + dot(n, normal[k]), T{} + 0.5f);
    shares += share;
  }
  return p + n * (height / shares);
}

}  // namespace pleat
