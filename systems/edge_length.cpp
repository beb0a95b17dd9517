#include "systems/edge_length.h"

#include <algorithm>

#include "components/edge_block.h"
#include "components/wide.h"

namespace pleat {
namespace {

constexpr float kSureSide = 0.4f;  // of 1, from which on the fold has its full height
constexpr float kTiny = 1e-20f;

constexpr float kPaperTolerance = 1e-3f;  // of the length; half of it is left to the error of the chord sums
constexpr float kPaperStart = 1.4f;       // k of eq (6)
constexpr int kMaxBisections = 64;

struct Fold {
  Vec3 direction;
  float height;
};

// Free of branches: the compiler runs it on several edges at once.
inline Fold pleat_fold(const PnEdge& c, const Vec3& normals, float target, float chosen_side) {
  const PnEdgeSpeeds speed2 = squared_speeds(c);
  const float length0 = curve_length(speed2);

  const auto [n, defined] = fold_direction(c.middle_tangent(), normals);

  // |c' + h s' n|^2 = |c'|^2 + 2 h rise + (h s')^2
  const float dn = dot(c.d, n), un = dot(c.u, n), vn = dot(c.v, n);
  PnEdgeSpeeds rise;
  float slope = 0.0f;  // dL/dh at h = 0
  for (std::size_t i = 0; i < kPnEdgeNodes.size(); ++i) {
    const PnEdgeNode& q = kPnEdgeNodes[i];
    rise[i] = q.fold_rate * (dn + q.u_rate * un + q.v_rate * vn);
    slope += q.weight * rise[i] / std::sqrt(speed2[i]);
  }
  const float side = chosen_side < 0.0f ? -1.0f : 1.0f;
  slope *= side;

  const FoldHeight start = fold_height(length0, target, slope);
  float h = start.height;

  float length_h = 0.0f;
  for (std::size_t i = 0; i < kPnEdgeNodes.size(); ++i) {
    const PnEdgeNode& q = kPnEdgeNodes[i];
    const float s = speed2[i] + h * (2.0f * side * rise[i] + h * q.fold_rate * q.fold_rate);
    length_h += q.weight * std::sqrt(s > kLeastSquaredSpeed ? s : kLeastSquaredSpeed);
  }
  const float slope_h = (start.beta + start.gamma * h) / start.wanted;  // of the closed form
  h += (start.wanted - length_h) / (slope_h > 1e-3f ? slope_h : 1e-3f);
  h = h < start.most ? h : start.most;
  h = h > 0.0f ? h : 0.0f;

  const float sure = chosen_side < 0.0f ? -chosen_side : chosen_side;
  const float height = side * (sure < kSureSide ? sure * (1.0f / kSureSide) : 1.0f) * defined * h;
  return {n, target > length0 ? height : 0.0f};
}

void run_pleat(const EdgeLength& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t begin = 0; begin < g.edge_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - begin);
    EdgeBlock block;
    Vec3Block direction;
    float side[kLanes], height[kLanes];
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      side[lane] = s.side[begin + std::min(lane, count - 1)];
    }
    block.gather(g, s.position, s.normal, begin, count);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Fold fold = pleat_fold(block.curve(lane), block.na[lane] + block.nb[lane], block.target[lane], side[lane]);
      direction.set(lane, fold.direction);
      height[lane] = fold.height;
    }
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      s.fold.set(begin + lane, direction[lane]);
      s.fold_height[begin + lane] = height[lane];
    }
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

Fold paper_fold(const Vec3& a, const Vec3& b, const Vec3& na, const Vec3& nb, float target) {
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
    const Fold fold = paper_fold(s.position[i], s.position[j], s.normal[i], s.normal[j], g.edge_rest_length[e]);
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
