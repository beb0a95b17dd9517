// The curve that a PN triangle puts over one edge, and the fold that makes it longer.
//   A. Vlachos, J. Peters, C. Boyd, J. L. Mitchell, "Curved PN Triangles", 2001.
// It depends on nothing but the edge's two ends and their normals, so the two faces at the edge share it:
//   c(t) = a + t d - t (1 - t) ((1 - t) u + t v),   d = b - a,   u = (d.Na) Na,   v = -(d.Nb) Nb
// The fold moves the middle by h n and fades out towards both ends, which keep their tangents:
//   c(t) + h n s(2t),  s(x) = x^2 (3 - 2x), and mirrored beyond the middle.
// That is the cubic split in two by de Casteljau, with the joint and its two neighbours moved by h n.
#pragma once

#include <array>
#include <cstddef>

#include "components/lanes.h"

namespace pleat {

/// How far the fold has risen at t of the edge: 0 and flat at the ends, 1 and flat in the middle.
constexpr float fold_shape(float t) {
  const float x = 2.0f * (t < 0.5f ? t : 1.0f - t);
  return x * x * (3.0f - 2.0f * x);
}

/// T: float, or lanes of as many edges.
template <class T>
struct PnEdgeT {
  Vec3T<T> a, d, u, v;

  PnEdgeT() = default;
  /// a, b: the ends, m; na, nb: their unit normals.
  PLEAT_KERNEL PnEdgeT(const Vec3T<T>& a_, const Vec3T<T>& b, const Vec3T<T>& na, const Vec3T<T>& nb)
      : a(a_), d(b - a_), u(na * dot(d, na)), v(nb * -dot(d, nb)) {}

  PLEAT_KERNEL Vec3T<T> point(float t) const { return a + d * t - (u * (1.0f - t) + v * t) * (t * (1.0f - t)); }
  Vec3T<T> middle() const { return a + d * 0.5f - (u + v) * 0.125f; }
  /// Along the tangent in the middle; not unit.
  Vec3T<T> middle_tangent() const { return d * 4.0f + (u - v); }
};
using PnEdge = PnEdgeT<float>;

/// One point of the quadrature along an edge: derivatives of the above, with c' = d + u_rate u + v_rate v.
struct PnEdgeNode {
  float weight;
  float u_rate, v_rate, fold_rate;
  float uu, vv, uv;  // |c'|^2 = d.d + uu u.u + vv v.v + uv u.v, for d.u = u.u and d.v = -v.v
};

/// Four Gauss points on each half of the edge, for the fold is a cubic on each.
inline constexpr std::array<PnEdgeNode, 8> kPnEdgeNodes = [] {
  constexpr float kPoint[4] = {0.0694318442f, 0.3300094782f, 0.6699905218f, 0.9305681558f};
  constexpr float kWeight[4] = {0.1739274226f, 0.3260725774f, 0.3260725774f, 0.1739274226f};
  std::array<PnEdgeNode, 8> nodes{};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool first_half = i < 4;
    const float x = kPoint[i % 4], t = 0.5f * (first_half ? x : 1.0f + x);
    const float u_rate = (1.0f - t) * (3.0f * t - 1.0f), v_rate = t * (3.0f * t - 2.0f);
    nodes[i] = {.weight = 0.5f * kWeight[i % 4],
                .u_rate = u_rate,
                .v_rate = v_rate,
                .fold_rate = (first_half ? 12.0f : -12.0f) * x * (1.0f - x),
                .uu = u_rate * (u_rate + 2.0f),
                .vv = v_rate * (v_rate - 2.0f),
                .uv = 2.0f * u_rate * v_rate};
  }
  return nodes;
}();
template <class T>
using PnEdgeSpeeds = std::array<T, kPnEdgeNodes.size()>;  // |c'|^2 at the nodes, m^2

/// Squared speeds below this, m^2, are taken for it: a collapsed edge has a length and no direction.
inline constexpr float kLeastSquaredSpeed = 1e-16f;

/// |c'|^2 at each node, m^2.
template <class T>
inline PnEdgeSpeeds<T> squared_speeds(const PnEdgeT<T>& c) {
  const T dd = dot(c.d, c.d), uu = dot(c.u, c.u), vv = dot(c.v, c.v), uv = dot(c.u, c.v);
  PnEdgeSpeeds<T> speeds{};
  for (std::size_t i = 0; i < kPnEdgeNodes.size(); ++i) {
    const PnEdgeNode& q = kPnEdgeNodes[i];
    speeds[i] = max(dd + q.uu * uu + q.vv * vv + q.uv * uv, T{} + kLeastSquaredSpeed);
  }
  return speeds;
}

/// Length of the curve without a fold, m. Every user gets the same bits for the same edge.
template <class T>
inline T curve_length(const PnEdgeSpeeds<T>& squared_speed) {
  T l{};
  for (std::size_t i = 0; i < kPnEdgeNodes.size(); ++i) l += kPnEdgeNodes[i].weight * sqrt(squared_speed[i]);
  return l;
}

/// The root of the mean squared speed, m: the length where the curve is run through evenly, else a little more.
template <class T>
inline T mean_square_length(const PnEdgeT<T>& c) {
  return sqrt(dot(c.d, c.d) + (dot(c.u, c.u) + dot(c.v, c.v)) * (2.0f / 15.0f) + dot(c.u, c.v) * (1.0f / 15.0f));
}

/// The direction in which an edge folds: across the tangent of its middle, towards the sum of its ends' normals.
template <class T>
struct FoldDirection {
  Vec3T<T> n;  // unit
  T defined;   // 0 .. 1: less than 1 where the normals nearly oppose each other, since n turns at random there
};
template <class T>
inline FoldDirection<T> fold_direction(const Vec3T<T>& tangent, const Vec3T<T>& normals) {
  constexpr float kTiny = 1e-20f;
  const Vec3T<T> across = normals - tangent * (dot(normals, tangent) / (dot(tangent, tangent) + kTiny));
  const T width2 = dot(across, across);
  return {across * (1.0f / sqrt(width2 + kTiny)), min(4.0f * width2, T{} + 1.0f)};
}

/// The height of the fold that a short edge needs, for a straight edge exactly and for a curved one nearly.
template <class T>
struct FoldHeight {
  T wanted;       // m, the length to reach: deficit^2 / (deficit + onset) closer to the target than without a fold, so
                  // that the height of the fold sets in smoothly
  T beta, gamma;  // of the closed form: length0 dL/dh at h = 0, and its curvature
  T height;       // m, >= 0; 0 where the edge is not short
  T most;         // m: a fold against the bulge would first have to press that in, at any deficit; it stops here
};

/// length0: of the curve without a fold; target: what it should have, m; slope: dL/dh at h = 0, negative where the
/// fold goes against the bulge. The closed form is  gamma h^2 + 2 beta h = gap,  gap = wanted^2 - length0^2.
template <class T>
inline FoldHeight<T> fold_height(T length0, T target, T slope) {
  constexpr float kOnset = 0.0045f;  // deficit, over the length, at which half of it is closed
  constexpr float kMost = 2.0f;      // times the height over a straight edge
  constexpr float kTiny = 1e-20f;
  const T deficit = max(target - length0, T{});
  const T closed = deficit * deficit / (deficit + kOnset * target + kTiny);
  const T wanted = length0 + closed, gap = closed * (length0 + wanted);
  const T beta = length0 * slope;
  const T ratio = length0 / (wanted + kTiny), gamma = 4.0f + ratio * (0.52f + 0.28f * ratio);
  const T root = sqrt(beta * beta + gamma * gap), most = kMost * sqrt(gap / gamma);
  const T height = slope < 0.0f ? (root - beta) / gamma : gap / (beta + root + kTiny);
  return {wanted, beta, gamma, min(height, most), most};
}

}  // namespace pleat
