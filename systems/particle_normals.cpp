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

/// Shares of faces in kPaper: the sums at their corners take them times the cross product of two sides.
PLEAT_KERNEL std::array<Lanes, 3> force_shares(const Vec3Lanes (&x)[3], const Vec3Lanes& face, const Lanes (&rest)[3],
                                               float mean_length) {
  const auto force = [](const Vec3Lanes& side, const Lanes& rest_length) {
    return side * (length(side) / rest_length - 1.0f);
  };
  const Vec3Lanes ab = force(x[1] - x[0], rest[0]), bc = force(x[2] - x[1], rest[1]), ca = force(x[0] - x[2], rest[2]);
  const Lanes area2 = length(face), unit = area2 > 1e-12f ? 1.0f / (area2 * mean_length) : Lanes{};
  std::array<Lanes, 3> share = corner_weights<Lanes>({rest[0], rest[1], rest[2]}, mean_length);
  for (Lanes& s : share) s *= kBaseFallback;
  share[0] += unit * length(ab - ca), share[1] += unit * length(bc - ab), share[2] += unit * length(ca - bc);
  return share;
}

/// Reads into the padding of the garment's columns.
template <Weighting weighting>
PLEAT_KERNEL void sum_normals(const ParticleNormals& s) {
  const Garment& g = *s.garment;
  std::fill_n(s.sum, g.normal_count, Vec4{});
  for (std::uint32_t f = 0; f < g.face_count; f += kLanes) {
    const auto position = [&](std::size_t k) { return gather(s.position, g.face_particle[k].data() + f); };
    const auto length = [&](std::size_t k) { return gather(g.edge_rest_length.data(), g.face_edge[k].data() + f); };
    const Vec3Lanes x[3] = {position(0), position(1), position(2)};
    const Lanes rest[3] = {length(0), length(1), length(2)};
    const Vec3Lanes face = cross(x[1] - x[0], x[2] - x[0]);
    const std::array<Lanes, 3> share = weighting == Weighting::kForce
                                           ? force_shares(x, face, rest, g.mean_edge_length)
                                           : corner_weights<Lanes>({rest[0], rest[1], rest[2]}, g.mean_edge_length);
    const std::uint32_t count = std::min(kLanes, g.face_count - f);
    for (std::size_t k = 0; k < 3; ++k) scatter_add(face * share[k], g.face_normal[k].data() + f, count, s.sum);
  }
  for (std::uint32_t i = 0; i < g.normal_count; i += kLanes) {
    store(load(s.sum + i).vector, s.normal, i, std::min(kLanes, g.normal_count - i));
  }
  complete_normals(g, s.normal);
  normalize(s.normal, g.normal_count);
}

/// How far the fold that a short edge will need tilts the normals at its ends: that at the first by minus the returned
/// vector, that at the second by plus. The fold is that of a straight edge in closed form, on the side to which the
/// normals say the edge bulges.
PLEAT_KERNEL Vec3Lanes tilt_of_fold(const PnEdgeT<Lanes>& c, const Vec3Lanes& normals, const Lanes& target) {
  const Lanes dd = dot(c.d, c.d) + kTiny;
  const auto [n, defined] = fold_direction(c.d, normals);
  const Lanes slope = -0.5f * dot(c.u + c.v, n) / (target + kTiny);  // dL/dh at h = 0
  const Lanes height = fold_height(mean_square_length(c), target, abs(slope)).height;

  const Lanes believed = slope / sqrt(slope * slope + kSureSide * kSureSide);
  return c.d * (kTilt * height * believed * defined / dd);
}

/// Particles with what they take of a tilt.
PLEAT_KERNEL void pack_places(const ParticleNormals& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t i = 0; i < g.particle_count; i += kLanes) {
    Lanes share;
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      const std::uint32_t p = std::min(i + k, g.particle_count - 1);
      share[k] = static_cast<float>(static_cast<std::int32_t>(g.around_begin[p + 1] - g.around_begin[p]));
    }
    pack(load(s.position, i), 2.0f / max(share, all(1.0f)), s.place + i);
  }
}

PLEAT_KERNEL void tilt_normals(const ParticleNormals& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t i = 0; i < g.normal_count; i += kLanes) pack(load(s.normal, i), Lanes{}, s.sum + i);
  for (std::uint32_t e = 0; e < g.edge_count; e += kLanes) {
    const std::uint32_t *first = g.edge_normal[0].data() + e, *second = g.edge_normal[1].data() + e;
    const Vec4Lanes a = gather(s.place, g.edge_particle[0].data() + e),
                    b = gather(s.place, g.edge_particle[1].data() + e);
    const Vec3Lanes na = gather(s.normal, first), nb = gather(s.normal, second);
    const Vec3Lanes tilt =
        tilt_of_fold({a.vector, b.vector, na, nb}, na + nb, load(g.edge_rest_curve_length.data() + e));
    Four at_first[kLanes], at_second[kLanes];
    split(tilt * -a.w, Lanes{}, at_first), split(tilt * b.w, Lanes{}, at_second);
    const std::uint32_t count = std::min(kLanes, g.edge_count - e);
    for (std::uint32_t k = 0; k < count; ++k) {
      store(load_four(s.sum[first[k]]) + at_first[k], s.sum[first[k]]);
      store(load_four(s.sum[second[k]]) + at_second[k], s.sum[second[k]]);
    }
  }
  for (std::uint32_t i = 0; i < g.normal_count; i += kLanes) {
    const Vec3Lanes n = load(s.sum + i).vector;
    const LaneMask tilted = abs(dot(n, n) - 1.0f) > kRounding;  // else bit for bit
    store(choose(tilted, normalized_or(n, all(kAnyNormal)), n), s.normal, i, std::min(kLanes, g.normal_count - i));
  }
}

PLEAT_KERNEL void run_pleat(const ParticleNormals& s) {
  sum_normals<Weighting::kBase>(s);
  pack_places(s);
  for (int round = 0; round < kRounds; ++round) tilt_normals(s);
}

}  // namespace

bool ParticleNormals::validate() const {
  return mode <= SurfaceMode::kArcPn && garment != nullptr && position.x != nullptr && normal.x != nullptr &&
         sum != nullptr && (mode != SurfaceMode::kPleat || place != nullptr);
}

void ParticleNormals::run() const {
  switch (mode) {
    case SurfaceMode::kPaper:
      return run_wide(widest_vectors(), [this] { sum_normals<Weighting::kForce>(*this); });
    case SurfaceMode::kPleat:
      return run_wide(widest_vectors(), [this] { run_pleat(*this); });
    default:
      return run_wide(widest_vectors(), [this] { sum_normals<Weighting::kBase>(*this); });
  }
}

}  // namespace pleat
