#include "systems/edge_length.h"

#include <algorithm>

#include "components/wide.h"

namespace pleat {
namespace {

constexpr float kSureSide = 0.4f;  // of 1, from which on the fold has its full height
constexpr float kTiny = 1e-20f;

constexpr float kPaperTolerance = 1e-3f;  // of the length; half of it is left to the error of the chord sums
constexpr float kPaperStart = 1.4f;       // k of eq (6)
constexpr int kMaxBisections = 64;

template <class T>
struct Fold {
  Vec3T<T> direction;
  T height;
};

PLEAT_KERNEL Fold<Lanes> pleat_fold(const FoldCurve& edges, const Lanes& target, const Lanes& chosen_side) {
  const PnEdgeT<Lanes>& c = edges.curve;
  const auto& [n, defined] = edges.fold;
  const PnEdgeSpeeds<Lanes> speed2 = squared_speeds(c);
  const Lanes length0 = curve_length<Lanes>(speed2);

  // |c' + h s' n|^2 = |c'|^2 + 2 h rise + (h s')^2
  const Lanes dn = dot(c.d, n), un = dot(c.u, n), vn = dot(c.v, n);
  PnEdgeSpeeds<Lanes> rise, speed;
  for (std::size_t i = 0; i < kPnEdgeNodes.size(); ++i) {
    const PnEdgeNode& q = kPnEdgeNodes[i];
    rise[i] = q.fold_rate * (dn + q.u_rate * un + q.v_rate * vn);
    speed[i] = sqrt(speed2[i]);
  }
  // dL/dh at h = 0, the sum of weight * rise / speed, four of them over one denominator.
  const auto four = [&](std::size_t i) {
    const auto part = [&](std::size_t k) { return kPnEdgeNodes[k].weight * rise[k]; };
    const Lanes first = speed[i] * speed[i + 1], second = speed[i + 2] * speed[i + 3];
    return ((part(i) * speed[i + 1] + part(i + 1) * speed[i]) * second +
            (part(i + 2) * speed[i + 3] + part(i + 3) * speed[i + 2]) * first) /
           (first * second);
  };
  Lanes slope = four(0) + four(4);
  const Lanes side = chosen_side < 0.0f ? all(-1.0f) : all(1.0f);
  slope *= side;

  const FoldHeight<Lanes> start = fold_height(length0, target, slope);
  Lanes h = start.height, length_h{};
  for (std::size_t i = 0; i < kPnEdgeNodes.size(); ++i) {
    const PnEdgeNode& q = kPnEdgeNodes[i];
    const Lanes s = speed2[i] + h * (2.0f * side * rise[i] + h * q.fold_rate * q.fold_rate);
    length_h += q.weight * sqrt(max(s, all(kLeastSquaredSpeed)));
  }
  const Lanes slope_h = (start.beta + start.gamma * h) / start.wanted;  // of the closed form
  h += (start.wanted - length_h) / max(slope_h, all(1e-3f));
  h = max(min(h, start.most), Lanes{});

  const Lanes sure = min(abs(chosen_side) * (1.0f / kSureSide), all(1.0f));
  return {n, target > length0 ? side * sure * defined * h : Lanes{}};
}

PLEAT_KERNEL void run_pleat(const EdgeLength& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t e = 0; e < g.edge_count; e += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - e);
    const Lanes target = load(g.edge_rest_curve_length.data() + e), side = load(s.side + e);
    const Fold<Lanes> fold = s.curves != nullptr
                                 ? pleat_fold(s.curves[e / kLanes], target, side)
                                 : pleat_fold(FoldCurve(EdgeBlock(g, s.position, s.normal, e)), target, side);
    store(fold.direction, s.fold, e, count);
    store(fold.height, s.fold_height + e, count);
  }
}

/// The quadratic normal of a PN triangle in the middle of the edge (Vlachos et al. 2001).
Vec3 quadratic_normal(const Vec3& d, const Vec3& na, const Vec3& nb) {
  const Vec3 sum = na + nb;
  const Vec3 reflected = sum - d * (2.0f * dot(d, sum) / std::max(dot(d, d), kTiny));
  return normalized_or(sum + normalized_or(reflected, {}), na);
}

/// Length by sums of 16 and of 8 chords, extrapolated to infinitely many.
float chord_length(const PnEdge& c) {
  constexpr int kChords = 16;
  Vec3 point[kChords + 1];
  for (int i = 0; i <= kChords; ++i) point[i] = c.point(static_cast<float>(i) / kChords);
  float fine = 0.0f, coarse = 0.0f;
  for (int i = 0; i < kChords; i += 2) {
    fine += length(point[i + 1] - point[i]) + length(point[i + 2] - point[i + 1]);
    coarse += length(point[i + 2] - point[i]);
  }
  return (4.0f * fine - coarse) / 3.0f;
}

Fold<float> paper_fold(const Vec3& a, const Vec3& b, const Vec3& na, const Vec3& nb, float target) {
  const Vec3 n = quadratic_normal(b - a, na, nb), middle = PnEdge(a, b, na, nb).middle();
  const auto missing = [&](float h) {
    const Vec3 p = middle + n * h;
    return target - chord_length(PnEdge(a, p, na, n)) - chord_length(PnEdge(p, b, n, nb));
  };
  const float tolerance = 0.5f * kPaperTolerance * target;
  if (missing(0.0f) <= tolerance) return {n, 0.0f};

  float h = std::max(kPaperStart * (target - length(b - a)), tolerance);  // eq (6)
  float low = 0.0f, high = 0.0f;                                          // high: none yet
  for (int i = 0; i < kMaxBisections; ++i) {
    const float m = missing(h);
    if (std::abs(m) <= tolerance) break;
    (m > 0.0f ? low : high) = h;
    h = high == 0.0f ? 2.0f * h : 0.5f * (low + high);
  }
  return {n, h};
}

void run_paper(const EdgeLength& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    const Fold<float> fold = paper_fold(s.position[i], s.position[j], s.normal[i], s.normal[j], g.edge_rest_length[e]);
    s.fold.set(e, fold.direction);
    s.fold_height[e] = fold.height;
  }
}

}  // namespace

bool EdgeLength::validate() const {
  return has_folds(mode) && garment != nullptr && position.x != nullptr && normal.x != nullptr && fold.x != nullptr &&
         fold_height != nullptr && (mode != SurfaceMode::kPleat || side != nullptr);
}

void EdgeLength::run() const {
  if (mode == SurfaceMode::kPaper) return run_paper(*this);
  run_wide(widest_vectors(), [this] { run_pleat(*this); });
}

}  // namespace pleat
