#include "systems/particle_normals.h"

#include <algorithm>

#include "components/base_normal.h"
#include "components/creases.h"
#include "components/edge_block.h"
#include "components/wide.h"

namespace pleat {
namespace {

constexpr int kRounds = 2;          // of looking at the folds
constexpr float kTilt = 6.8f;       // of the normals at the ends of a fold, over its steepness
constexpr float kSureSide = 0.43f;  // dL/dh at h = 0 at which 70 % of a fold is believed
constexpr float kRounding = 1e-6f;  // of a unit vector's square
constexpr float kTiny = 1e-20f;
constexpr float kBaseFallback = 1e-9f;  // the base normal's share in kPaper, below any force but zero

enum class Weighting { kBase, kForce };

/// Shares of a face in kPaper: the sums at its corners take them times the cross product of two sides.
inline std::array<float, 3> force_shares(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& face,
                                         const std::array<float, 3>& rest_length, float mean_length) {
  const auto force = [](const Vec3& side, float rest) { return side * (length(side) / rest - 1.0f); };
  const Vec3 ab = force(b - a, rest_length[0]), bc = force(c - b, rest_length[1]), ca = force(a - c, rest_length[2]);
  const float area2 = length(face);
  const float unit = area2 > 1e-12f ? 1.0f / (area2 * mean_length) : 0.0f;
  std::array<float, 3> share = corner_weights(rest_length, mean_length);
  for (float& x : share) x *= kBaseFallback;
  share[0] += unit * length(ab - ca), share[1] += unit * length(bc - ab), share[2] += unit * length(ca - bc);
  return share;
}

template <Weighting weighting>
void sum_normals(const ParticleNormals& s) {
  const Garment& g = *s.garment;
  clear(s.normal, g.normal_count);
  for (std::uint32_t begin = 0; begin < g.face_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - begin);
    Vec3Block x[3], sum[3];
    float rest_length[3][kLanes];
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t f = begin + std::min(lane, count - 1);
      for (std::size_t k = 0; k < 3; ++k) {
        x[k].set(lane, s.position[g.face_particle[k][f]]);
        rest_length[k][lane] = g.edge_rest_length[g.face_edge[k][f]];
      }
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Vec3 a = x[0][lane], b = x[1][lane], c = x[2][lane], face = cross(b - a, c - a);
      const std::array<float, 3> rest{rest_length[0][lane], rest_length[1][lane], rest_length[2][lane]};
      const std::array<float, 3> share = weighting == Weighting::kForce
                                             ? force_shares(a, b, c, face, rest, g.mean_edge_length)
                                             : corner_weights(rest, g.mean_edge_length);
      for (std::size_t k = 0; k < 3; ++k) sum[k].set(lane, face * share[k]);
    }
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      for (std::size_t k = 0; k < 3; ++k) s.normal.add(g.face_normal[k][begin + lane], sum[k][lane]);
    }
  }
  complete_normals(g, s.normal);
  normalize(s.normal, g.normal_count);
}

/// How far the fold that a short edge will need tilts the normals at its ends: that at the first by minus the returned
/// vector, that at the second by plus. The fold is that of a straight edge in closed form, on the side to which the
/// normals say the edge bulges.
inline Vec3 tilt_of_fold(const PnEdge& c, const Vec3& normals, float target) {
  const float dd = dot(c.d, c.d) + kTiny;
  const auto [n, defined] = fold_direction(c.d, normals);
  const float slope = -0.5f * dot(c.u + c.v, n) / (target + kTiny);  // dL/dh at h = 0
  const float height = fold_height(mean_square_length(c), target, slope < 0.0f ? -slope : slope).height;

  const float believed = slope / std::sqrt(slope * slope + kSureSide * kSureSide);
  return c.d * (kTilt * height * believed * defined / dd);
}

void tilt_normals(const ParticleNormals& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t begin = 0; begin < g.edge_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - begin);
    EdgeBlock block;
    Vec3Block tilt;
    block.gather(g, s.position, s.normal, begin, count);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      tilt.set(lane, tilt_of_fold(block.curve(lane), block.na[lane] + block.nb[lane], block.target[lane]));
    }
    for (std::uint32_t lane = 0; lane < count; ++lane) s.fold.set(begin + lane, tilt[lane]);
  }
  const auto share = [&](std::uint32_t i) {
    return 2.0f / static_cast<float>(std::max(g.around_begin[i + 1] - g.around_begin[i], 1u));
  };
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const Vec3 tilt = s.fold[e];
    s.normal.add(g.edge_normal[0][e], tilt * -share(g.edge_particle[0][e]));
    s.normal.add(g.edge_normal[1][e], tilt * share(g.edge_particle[1][e]));
  }
  for (std::uint32_t i = 0; i < g.normal_count; ++i) {
    const Vec3 n = s.normal[i];
    if (std::abs(dot(n, n) - 1.0f) > kRounding) s.normal.set(i, normalized_or(n, kAnyNormal));  // else bit for bit
  }
}

void run_pleat(const ParticleNormals& s) {
  sum_normals<Weighting::kBase>(s);
  for (int round = 0; round < kRounds; ++round) tilt_normals(s);
}

}  // namespace

bool ParticleNormals::validate() const {
  return mode <= SurfaceMode::kArcPn && garment != nullptr && position.x != nullptr && normal.x != nullptr &&
         (mode != SurfaceMode::kPleat || fold.x != nullptr);
}

void ParticleNormals::run() const {
  switch (mode) {
    case SurfaceMode::kPaper:
      return sum_normals<Weighting::kForce>(*this);
    case SurfaceMode::kPleat:
      return run_wide(widest_vectors(), [this] { run_pleat(*this); });
    default:
      return run_wide(widest_vectors(), [this] { sum_normals<Weighting::kBase>(*this); });
  }
}

}  // namespace pleat
