// Where four pairs of triangles come closest, side by side: bit for bit what closest_between_triangles finds for each.
#pragma once

#include <limits>

#include "components/lanes.h"
#include "systems/closest_points.h"

namespace pleat {

using Vec3Four = Vec3T<Four>;
using FourMask = std::int32_t __attribute__((vector_size(4 * sizeof(std::int32_t))));  // -1 or 0
using Doubles = double __attribute__((vector_size(4 * sizeof(double))));
using DoubleMask = decltype(Doubles{} < Doubles{});
using Vec3Doubles = Vec3T<Doubles>;

/// Barycentrics of four points.
struct FourBarycentrics {
  Four a, b, c;

  Barycentrics operator[](std::size_t lane) const { return {a[lane], b[lane], c[lane]}; }
  PLEAT_KERNEL Vec3Four point(const Vec3Four (&corner)[3]) const {
    return corner[0] * a + corner[1] * b + corner[2] * c;
  }
};

/// Four triangles in double.
struct FourTriangles {
  Vec3Doubles corner[3], side[3];  // m; from corner k to the next
  Doubles length2[3];              // of the sides, m2
  DoubleMask flat;                 // without area, as closest_on_triangle sees it

  PLEAT_KERNEL explicit FourTriangles(const Vec3Four (&x)[3]) {
    const auto exact = [](const Four& v) PLEAT_KERNEL_LAMBDA { return __builtin_convertvector(v, Doubles); };
    for (std::size_t k = 0; k < 3; ++k) corner[k] = {exact(x[k].x), exact(x[k].y), exact(x[k].z)};
    for (std::size_t k = 0; k < 3; ++k) {
      side[k] = corner[(k + 1) % 3] - corner[k];
      length2[k] = dot(side[k], side[k]);
    }
    const Vec3Doubles ac = corner[2] - corner[0], normal = cross(side[0], ac);
    flat = dot(normal, normal) <= 1e-14 * length2[0] * dot(ac, ac);
  }
};

/// The points of four pairs that are closest to each other.
class TrianglePairs {
 public:
  FourBarycentrics first{}, second{};

  PLEAT_KERNEL TrianglePairs(const Vec3Four (&p)[3], const Vec3Four (&q)[3]) : p_(p), q_(q) {
    const FourTriangles a(p), b(q);
    corners_over(p_, a, q_, b, [&](const auto& from, const auto& over, const auto& valid) PLEAT_KERNEL_LAMBDA {
      consider(from, over, valid);
    });
    if (any_of(~done_)) {
      corners_over(q_, b, p_, a, [&](const auto& from, const auto& over, const auto& valid) PLEAT_KERNEL_LAMBDA {
        consider(over, from, valid);
      });
    }
    if (any_of(~done_)) sides(a, b);
    const DoubleMask flat = a.flat | b.flat;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if (flat[lane] != 0) set(lane);
    }
  }

 private:
  const Vec3Four (&p_)[3];
  const Vec3Four (&q_)[3];
  Four least_ = Four{} + std::numeric_limits<float>::max();
  FourMask done_{};

  static PLEAT_KERNEL bool any_of(const FourMask& mask) {
    std::int64_t halves[2];
    std::memcpy(halves, &mask, sizeof halves);
    return (halves[0] | halves[1]) != 0;
  }
  static PLEAT_KERNEL FourMask narrow(const DoubleMask& mask) { return __builtin_convertvector(mask, FourMask); }
  static PLEAT_KERNEL DoubleMask widen(const FourMask& mask) { return __builtin_convertvector(mask, DoubleMask); }
  static PLEAT_KERNEL Four rounded(const Doubles& v) { return __builtin_convertvector(v, Four); }
  static PLEAT_KERNEL Doubles clamped(const Doubles& v) { return v < 0.0 ? Doubles{} : v > 1.0 ? Doubles{} + 1.0 : v; }
  static PLEAT_KERNEL Doubles ratio(const Doubles& numerator, const Doubles& denominator) {
    const DoubleMask good = denominator > 0.0;
    return good ? clamped(numerator / (good ? denominator : Doubles{} + 1.0)) : Doubles{};
  }
  static PLEAT_KERNEL Vec3Doubles chosen(const DoubleMask& mask, const Vec3Doubles& a, const Vec3Doubles& b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
  }
  static PLEAT_KERNEL void choose(const FourMask& mask, const FourBarycentrics& from, FourBarycentrics& to) {
    to.a = mask ? from.a : to.a, to.b = mask ? from.b : to.b, to.c = mask ? from.c : to.c;
  }

  PLEAT_KERNEL FourMask is_nearer(const Vec3Four& d, const FourMask& valid) {
    const Four distance2 = dot(d, d);
    const FourMask nearer = (distance2 < least_) & valid & ~done_;
    least_ = nearer ? distance2 : least_;
    return nearer;
  }
  PLEAT_KERNEL void consider(const FourBarycentrics& on_p, const FourBarycentrics& on_q, const FourMask& valid) {
    const FourMask nearer = is_nearer(on_p.point(p_) - on_q.point(q_), valid);
    choose(nearer, on_p, first), choose(nearer, on_q, second);
  }

  /// As closest_on_triangle, where the triangle has an area.
  static PLEAT_KERNEL FourBarycentrics closest_on(const Vec3Doubles& p, const FourTriangles& t) {
    const Vec3Doubles ab = t.side[0], ac = t.corner[2] - t.corner[0];
    const Vec3Doubles ap = p - t.corner[0], bp = p - t.corner[1], cp = p - t.corner[2];
    const Doubles ab_ap = dot(ab, ap), ac_ap = dot(ac, ap), ab_bp = dot(ab, bp), ac_bp = dot(ac, bp);
    const Doubles ab_cp = dot(ab, cp), ac_cp = dot(ac, cp);
    const Doubles area_c = ab_ap * ac_bp - ab_bp * ac_ap, area_b = ab_cp * ac_ap - ab_ap * ac_cp;
    const Doubles area_a = ab_bp * ac_cp - ab_cp * ac_bp, along = ac_bp - ab_bp, back = ab_cp - ac_cp;
    const DoubleMask at_a = (ab_ap <= 0.0) & (ac_ap <= 0.0), at_b = ~at_a & (ab_bp >= 0.0) & (ac_bp <= ab_bp);
    const DoubleMask at_c = ~at_a & ~at_b & (ac_cp >= 0.0) & (ab_cp <= ac_cp);
    const DoubleMask on_ab = at_a | at_b | (~at_c & (area_c <= 0.0) & (ab_ap >= 0.0) & (ab_bp <= 0.0));
    const DoubleMask on_ca = ~on_ab & (at_c | ((area_b <= 0.0) & (ac_ap >= 0.0) & (ac_cp <= 0.0)));
    const DoubleMask on_bc = ~on_ab & ~on_ca & (area_a <= 0.0) & (along >= 0.0) & (back >= 0.0);
    const DoubleMask on_side = on_ab | on_ca | on_bc;

    const Doubles length = on_ab ? ab_ap - ab_bp : on_ca ? ac_ap - ac_cp : along + back;
    const Doubles divisor = on_side ? (length > 0.0 ? length : Doubles{} + 1.0) : area_a + area_b + area_c;
    const Doubles quotient = (on_side ? (on_ab ? ab_ap : on_ca ? ac_ap : along) : Doubles{} + 1.0) / divisor;
    const Doubles part = length > 0.0 ? clamped(quotient) : Doubles{};
    const Doubles at = at_a ? Doubles{} : (at_b | at_c) ? Doubles{} + 1.0 : part;
    const Four b = rounded(on_ab ? at : on_side ? Doubles{} : area_b * quotient);
    const Four c = rounded(on_ab ? Doubles{} : on_side ? at : area_c * quotient);
    const Four rest = 1.0f - b - c, inside = rest > 0.0f ? rest : Four{};
    const FourMask past_a = narrow(on_bc);
    return {past_a ? Four{} : inside, past_a ? rest : b, c};
  }

  /// A corner over the other's inside, where it stands out most, is the answer: then the pair is done.
  template <class Found>
  PLEAT_KERNEL void corners_over(const Vec3Four (&from)[3], const FourTriangles& from_exact, const Vec3Four (&over)[3],
                                 const FourTriangles& over_exact, const Found& found) {
    const Vec3Four area = cross(over[1] - over[0], over[2] - over[0]);
    Four h[3], height[3];
    for (std::size_t k = 0; k < 3; ++k) {
      h[k] = dot(from[k] - over[0], area);
      height[k] = h[k] < 0.0f ? -h[k] : h[k];
    }
    const FourMask one_side = ((h[0] > 0.0f) == (h[1] > 0.0f)) & ((h[1] > 0.0f) == (h[2] > 0.0f));
    const FourMask first_is = height[0] <= (height[2] < height[1] ? height[2] : height[1]);
    const FourMask second_is = ~first_is & (height[1] <= height[2]), third_is = ~first_is & ~second_is;

    // The nearest of those on one side, the first corner of the others; then those others' second and third.
    const FourMask corner[3] = {~one_side | first_is, one_side & second_is, one_side & third_is};
    const Vec3Doubles* x = from_exact.corner;
    const FourBarycentrics at =
        closest_on(chosen(widen(corner[0]), x[0], chosen(widen(corner[1]), x[1], x[2])), over_exact);
    const Four one = Four{} + 1.0f;
    found(FourBarycentrics{corner[0] ? one : Four{}, corner[1] ? one : Four{}, corner[2] ? one : Four{}}, at,
          FourMask{} - 1);
    done_ |= one_side & (at.a > 0.0f) & (at.b > 0.0f) & (at.c > 0.0f);
    if (!any_of(~one_side & ~done_)) return;
    found(FourBarycentrics{Four{}, one, Four{}}, closest_on(x[1], over_exact), ~one_side);
    found(FourBarycentrics{Four{}, Four{}, one}, closest_on(x[2], over_exact), ~one_side);
  }

  /// As closest_between_segments, of every side with every other.
  PLEAT_KERNEL void sides(const FourTriangles& a, const FourTriangles& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3Doubles u = a.side[i], v = b.side[k], w = a.corner[i] - b.corner[k];
        const Doubles uu = a.length2[i], vv = b.length2[k], uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
        const Doubles on_line = ratio(uv * vw - uw * vv, uu * vv - uv * uv), across = (uv * on_line + vw) / vv;
        const DoubleMask before = across<0.0, behind = across> 1.0;
        const Doubles from_end = ratio(before ? -uw : uv - uw, uu);
        consider_sides(i, k, rounded((before | behind) ? from_end : on_line), rounded(clamped(across)));
      }
    }
  }
  PLEAT_KERNEL void consider_sides(std::size_t i, std::size_t k, const Four& s, const Four& t) {
    const std::size_t i2 = (i + 1) % 3, k2 = (k + 1) % 3;
    const Four s0 = 1.0f - s, t0 = 1.0f - t;
    const FourMask nearer = is_nearer(p_[i] * s0 + p_[i2] * s - (q_[k] * t0 + q_[k2] * t), FourMask{} - 1);
    if (!any_of(nearer)) return;
    Four on_p[3]{}, on_q[3]{};
    on_p[i] = s0, on_p[i2] = s, on_q[k] = t0, on_q[k2] = t;
    choose(nearer, {on_p[0], on_p[1], on_p[2]}, first), choose(nearer, {on_q[0], on_q[1], on_q[2]}, second);
  }

  void set(std::size_t lane) {
    Vec3 p[3], q[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = {p_[k].x[lane], p_[k].y[lane], p_[k].z[lane]}, q[k] = {q_[k].x[lane], q_[k].y[lane], q_[k].z[lane]};
    }
    const TrianglePair found = closest_between_triangles(p, q);
    first.a[lane] = found.first.a, first.b[lane] = found.first.b, first.c[lane] = found.first.c;
    second.a[lane] = found.second.a, second.b[lane] = found.second.b, second.c[lane] = found.second.c;
  }
};

}  // namespace pleat
