// How features of a cloth and of a mesh body are over each other. One source for a pair and for eight of them: the same
// bits. T: float, or Lanes of as many pairs.
#pragma once

#include "components/lanes.h"

namespace pleat {

/// A vertex q of a body seen from a face x.
template <class T>
struct VertexOverFace {
  T height;  // of the face over the vertex, m
  T b1, b2;  // barycentrics of q's place on the face
  decltype(T{} < T{}) over;

  PLEAT_KERNEL VertexOverFace(const Vec3T<T> (&x)[3], const Vec3T<T>& q) {
    const Vec3T<T> u = x[1] - x[0], v = x[2] - x[0], w = q - x[0], area = cross(u, v);
    const T area2 = dot(area, area);
    const auto has_area = area2 > 1e-16f;
    const T divisor = has_area ? area2 : T{} + 1.0f;
    height = -dot(w, area) / sqrt(divisor);
    b1 = dot(cross(w, v), area) / divisor, b2 = dot(cross(u, w), area) / divisor;
    over = has_area & (b1 > 0.0f) & (b2 > 0.0f) & (b1 + b2 < 1.0f);
  }
  PLEAT_KERNEL auto within(float reach) const { return over & (height <= reach) & (height >= -reach); }
};

/// A vertex q of a body beside an edge from a to b.
template <class T>
struct VertexAtEdge {
  T s;            // its foot is lerp(a, b, s)
  Vec3T<T> away;  // from q to there, m
  T distance2;    // m2
  decltype(T{} < T{}) beside;

  PLEAT_KERNEL VertexAtEdge(const Vec3T<T>& a, const Vec3T<T>& b, const Vec3T<T>& q) {
    const Vec3T<T> along = b - a, w = q - a;
    const T length2 = dot(along, along), reached = dot(w, along);
    beside = (reached > 0.0f) & (reached < length2);
    s = reached / (beside ? length2 : T{} + 1.0f);
    away = along * s - w;
    distance2 = dot(away, away);
  }
  PLEAT_KERNEL auto within(float reach) const { return beside & (distance2 < reach * reach); }
};

/// An edge p of a cloth and an edge q of a body. Seen along their common normal they cross where p[0] + s / common2 of
/// p is over q[0] + r / common2 of q.
template <class T>
struct EdgesFacing {
  Vec3T<T> common;
  T common2, s, r;
  T gap;  // m, times the normal's length
  decltype(T{} < T{}) cross_each_other;

  PLEAT_KERNEL EdgesFacing(const Vec3T<T>& p0, const Vec3T<T>& p1, const Vec3T<T>& q0, const Vec3T<T>& q1) {
    const Vec3T<T> edge = p1 - p0, along = q1 - q0, between = q0 - p0;
    common = cross(edge, along);
    common2 = dot(common, common), gap = dot(between, common);
    s = dot(cross(between, along), common), r = dot(cross(between, edge), common);
    cross_each_other = (s > 0.0f) & (s < common2) & (r > 0.0f) & (r < common2);
  }
  PLEAT_KERNEL auto within(float reach) const { return cross_each_other & (gap * gap < reach * reach * common2); }
};

/// The sweeps turn what rows were made for; ridges and vertices of the body that are next to be met then have theirs
/// already, else cloth that lies on two of them falls to one and the other by turns. A face beside a pin turns by a
/// slope of 0.1 in a substep, an edge beside one by more.
inline constexpr float kTurn = 0.2f;

/// Whether an edge p of a cloth may be the first to touch a ridge q of a body, and in which direction. q: the places of
/// Ridge::vertex.
template <class T>
struct RidgeFacing {
  Vec3T<T> normal;  // unit, out of the body
  decltype(T{} < T{}) met;

  PLEAT_KERNEL RidgeFacing(const EdgesFacing<T>& at, const Vec3T<T>& p0, const Vec3T<T>& p1, const Vec3T<T> (&q)[4]) {
    const Vec3T<T> along = q[1] - q[0], area1 = cross(along, q[2] - q[0]), area2 = cross(q[3] - q[0], along);
    const T size1 = length(area1), size2 = length(area2);
    const Vec3T<T> n1 = area1 * inverse_or_0(size1), n2 = area2 * inverse_or_0(size2);
    // Of the ridge's two faces, the directions into them; a valley or a flat edge is never met first.
    const Vec3T<T> into1 = cross(n1, along), into2 = cross(along, n2);
    const T length1 = length(into1), length2 = length(into2);
    const auto stands_out = dot(n1, into2) <= -1e-3f * length2;
    const auto inwards = dot(at.common, n1 + n2) < 0.0f;
    const T size = inverse_or_0(sqrt(at.common2));
    normal = at.common * (inwards ? -size : size);
    // The heights of the two triangles over the ridge are the distances to the next ones. Less is missed of an edge, by
    // its length, where these are nearer than it is long.
    const T far = sqrt(dot(p1 - p0, p1 - p0) * dot(along, along));
    const auto turned1 = dot(normal, into1) * far <= kTurn * min(size1, far) * length1;
    const auto turned2 = dot(normal, into2) * far <= kTurn * min(size2, far) * length2;
    met = stands_out & turned1 & turned2;
  }

 private:
  static PLEAT_KERNEL T inverse_or_0(const T& a) {
    const auto good = a > 1e-12f;
    return good ? 1.0f / (good ? a : T{} + 1.0f) : T{};
  }
};

}  // namespace pleat
