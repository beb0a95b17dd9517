// The points where two features of cloth face each other. One source for a pair and for eight of them: the same bits.
#pragma once

#include "components/lanes.h"
#include "components/near_pairs.h"

namespace pleat {

/// Of four points, as closeness.h has them. T: float, or lanes of as many pairs.
template <class T>
struct FacingT {
  T weight[4];    // as those of Closeness
  Vec3T<T> area;  // along the normal
  T area2;
  T volume;                  // six times that of the tetrahedron: its sign is the side
  decltype(T{} < T{}) over;  // they are over each other; else weights mean nothing
};

template <class T>
PLEAT_KERNEL FacingT<T> face_particle(const Vec3T<T> (&x)[4]) {
  constexpr float kOverlap = 0.05f;  // so far faces reach beyond their border: no gap where a particle lies on an edge
  const Vec3T<T> u = x[2] - x[1], v = x[3] - x[1], w = x[0] - x[1];
  FacingT<T> f;
  f.area = cross(u, v), f.area2 = dot(f.area, f.area), f.volume = dot(w, f.area);
  const auto has_area = f.area2 > 1e-16f;
  const T divisor = has_area ? f.area2 : T{} + 1.0f;
  const T b = dot(cross(w, v), f.area) / divisor, c = dot(cross(u, w), f.area) / divisor, a = 1.0f - b - c;
  f.weight[0] = T{} + 1.0f, f.weight[1] = -a, f.weight[2] = -b, f.weight[3] = -c;
  f.over = has_area & (min(min(a, b), c) > -kOverlap);
  return f;
}

template <class T>
PLEAT_KERNEL FacingT<T> face_edge(const Vec3T<T> (&x)[4]) {
  constexpr float kLeastSine2 = 0.01f;  // between edges
  const Vec3T<T> u = x[1] - x[0], v = x[3] - x[2], w = x[0] - x[2];
  FacingT<T> f;
  f.area = cross(u, v), f.area2 = dot(f.area, f.area), f.volume = dot(w, f.area);
  const auto has_area = (f.area2 > 1e-16f) & (f.area2 > kLeastSine2 * dot(u, u) * dot(v, v));
  const T divisor = has_area ? f.area2 : T{} + 1.0f;
  const T s = dot(cross(v, w), f.area) / divisor, t = dot(cross(u, w), f.area) / divisor;
  f.weight[0] = 1.0f - s, f.weight[1] = s, f.weight[2] = t - 1.0f, f.weight[3] = -t;
  f.over = has_area & (min(min(s, 1.0f - s), min(t, 1.0f - t)) > 0.0f);
  return f;
}

template <class T>
PLEAT_KERNEL FacingT<T> facing(NearKind kind, const Vec3T<T> (&x)[4]) {
  return kind == NearKind::kEdges ? face_edge(x) : face_particle(x);
}

}  // namespace pleat
