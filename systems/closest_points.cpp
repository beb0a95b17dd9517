#include "systems/closest_points.h"

#include <limits>

namespace pleat {
namespace {

using Vec3d = Vec3T<double>;

Vec3d difference(const Vec3& a, const Vec3& b) {
  return {double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z}};
}

double ratio_in_unit_interval(double numerator, double denominator) {
  return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
}

/// Of a triangle without area: the closest point on its three edges.
Barycentrics closest_on_edges(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const float ab = closest_on_segment(p, a, b), bc = closest_on_segment(p, b, c), ca = closest_on_segment(p, c, a);
  Barycentrics best{1.0f - ab, ab, 0.0f};
  float best_distance2 = std::numeric_limits<float>::max();
  for (const Barycentrics& w : {best, Barycentrics{0.0f, 1.0f - bc, bc}, Barycentrics{ca, 0.0f, 1.0f - ca}}) {
    const Vec3 d = w.point(a, b, c) - p;
    if (dot(d, d) < best_distance2) best = w, best_distance2 = dot(d, d);
  }
  return best;
}

Barycentrics on_edge(int k, float t) {
  float w[3] = {};
  w[k] = 1.0f - t, w[(k + 1) % 3] = t;
  return {w[0], w[1], w[2]};
}

}  // namespace

SegmentPair closest_between_segments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
  const Vec3d u = difference(p1, p0), v = difference(q1, q0), w = difference(p0, q0);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  if (vv <= 0.0) return {static_cast<float>(ratio_in_unit_interval(-uw, uu)), 0.0f};

  // Where the lines come closest, then each parameter in turn brought into its segment. Parallel lines: any s will do.
  const double s = ratio_in_unit_interval(uv * vw - uw * vv, uu * vv - uv * uv);
  const double t = (uv * s + vw) / vv;
  if (t < 0.0) return {static_cast<float>(ratio_in_unit_interval(-uw, uu)), 0.0f};
  if (t > 1.0) return {static_cast<float>(ratio_in_unit_interval(uv - uw, uu)), 1.0f};
  return {static_cast<float>(s), static_cast<float>(t)};
}

Barycentrics closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3d ab = difference(b, a), ac = difference(c, a), ap = difference(p, a);
  const Vec3d normal = cross(ab, ac);
  if (dot(normal, normal) <= 1e-14 * dot(ab, ab) * dot(ac, ac)) return closest_on_edges(p, a, b, c);

  const double ab_ap = dot(ab, ap), ac_ap = dot(ac, ap);
  if (ab_ap <= 0.0 && ac_ap <= 0.0) return {1.0f, 0.0f, 0.0f};

  const Vec3d bp = difference(p, b);
  const double ab_bp = dot(ab, bp), ac_bp = dot(ac, bp);
  if (ab_bp >= 0.0 && ac_bp <= ab_bp) return {0.0f, 1.0f, 0.0f};

  const Vec3d cp = difference(p, c);
  const double ab_cp = dot(ab, cp), ac_cp = dot(ac, cp);
  if (ac_cp >= 0.0 && ab_cp <= ac_cp) return {0.0f, 0.0f, 1.0f};

  const double area_c = ab_ap * ac_bp - ab_bp * ac_ap;
  if (area_c <= 0.0 && ab_ap >= 0.0 && ab_bp <= 0.0) {
    const float t = static_cast<float>(ratio_in_unit_interval(ab_ap, ab_ap - ab_bp));
    return {1.0f - t, t, 0.0f};
  }
  const double area_b = ab_cp * ac_ap - ab_ap * ac_cp;
  if (area_b <= 0.0 && ac_ap >= 0.0 && ac_cp <= 0.0) {
    const float t = static_cast<float>(ratio_in_unit_interval(ac_ap, ac_ap - ac_cp));
    return {1.0f - t, 0.0f, t};
  }
  const double area_a = ab_bp * ac_cp - ab_cp * ac_bp, along = ac_bp - ab_bp, back = ab_cp - ac_cp;
  if (area_a <= 0.0 && along >= 0.0 && back >= 0.0) {
    const float t = static_cast<float>(ratio_in_unit_interval(along, along + back));
    return {0.0f, 1.0f - t, t};
  }
  const double scale = 1.0 / (area_a + area_b + area_c);
  const float vb = static_cast<float>(area_b * scale), vc = static_cast<float>(area_c * scale);
  return {std::max(0.0f, 1.0f - vb - vc), vb, vc};
}

TrianglePair closest_between_triangles(const Vec3 (&p)[3], const Vec3 (&q)[3]) {
  TrianglePair best{};
  float least = std::numeric_limits<float>::max();
  const auto consider = [&](const Barycentrics& first, const Barycentrics& second) {
    const Vec3 d = first.point(p[0], p[1], p[2]) - second.point(q[0], q[1], q[2]);
    if (dot(d, d) < least) best = {first, second}, least = dot(d, d);
  };
  // A corner over the other's inside, where it stands out most, is the answer; else it is one of the candidates.
  constexpr Barycentrics kCorner[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto corners_over = [&](const Vec3(&from)[3], const Vec3(&over)[3], const auto& found) {
    const Vec3 area = cross(over[1] - over[0], over[2] - over[0]);
    const float h[] = {dot(from[0] - over[0], area), dot(from[1] - over[0], area), dot(from[2] - over[0], area)};
    const bool one_side = (h[0] > 0) == (h[1] > 0) && (h[1] > 0) == (h[2] > 0);
    const int nearest = std::abs(h[0]) <= std::min(std::abs(h[1]), std::abs(h[2])) ? 0
                        : std::abs(h[1]) <= std::abs(h[2])                         ? 1
                                                                                   : 2;
    for (int k = 0; k < 3; ++k) {
      if (one_side && k != nearest) continue;
      const Barycentrics at = closest_on_triangle(from[k], over[0], over[1], over[2]);
      found(kCorner[k], at);
      if (one_side && at.a > 0.0f && at.b > 0.0f && at.c > 0.0f) return true;
    }
    return false;
  };
  if (corners_over(p, q, consider)) return best;
  if (corners_over(q, p, [&](const Barycentrics& second, const Barycentrics& first) { consider(first, second); })) {
    return best;
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const SegmentPair at = closest_between_segments(p[i], p[(i + 1) % 3], q[k], q[(k + 1) % 3]);
      consider(on_edge(i, at.s), on_edge(k, at.t));
    }
  }
  return best;
}

}  // namespace pleat
