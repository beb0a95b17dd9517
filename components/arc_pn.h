// Arc-PN: PN triangles whose edges leave their ends as fast as a circular arc would.
// The cubic of a PN edge that turns by 2 alpha has tangents too short by cos alpha cos^2(alpha/2): its bulge is at most
// 1/8 of the chord where that of an arc goes on growing. Lengthened tangents are those of the best cubic for the arc.
#pragma once

#include "components/pn_edge.h"
#include "components/pn_triangle.h"

namespace pleat {

/// What takes the place of (side.n) n in a PN edge or triangle; side: from the end with normal n to the other end, m.
/// Beyond 75 degrees, cos alpha = 1/4, the tangent's length grows no further.
template <class T>
inline Vec3T<T> arc_bend(const Vec3T<T>& side, const Vec3T<T>& n) {
  const Vec3T<T> tangent = side - n * dot(side, n);
  const T cosine = sqrt(dot(tangent, tangent) / max(dot(side, side), T{} + 1e-30f)), bounded = max(cosine, T{} + 0.25f);
  return side - tangent * (2.0f / (bounded * (1.0f + bounded)));  // cos^2(alpha/2) = (1 + cos alpha) / 2
}

template <class T>
inline PnEdgeT<T> arc_edge(const Vec3T<T>& a, const Vec3T<T>& b, const Vec3T<T>& na, const Vec3T<T>& nb) {
  PnEdgeT<T> edge(a, b, na, nb);
  edge.u = arc_bend(edge.d, na);
  edge.v = arc_bend(-edge.d, nb);
  return edge;
}

template <class T>
inline PnTriangleT<T> arc_triangle(const Vec3T<T> (&p)[3], const Vec3T<T> (&n)[3]) {
  PnTriangleT<T> triangle(p, n);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    triangle.bend[2 * k] = arc_bend(p[l] - p[k], n[k]);
    triangle.bend[2 * k + 1] = arc_bend(p[k] - p[l], n[l]);
  }
  return triangle;
}

}  // namespace pleat
