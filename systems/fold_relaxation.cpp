#include "systems/fold_relaxation.h"

#include <algorithm>

#include "components/edge_block.h"

namespace pleat {
namespace {

// An edge's middle is the end of 2 halves and of up to 4 segments in faces, whose other ends move too: no curvature of
// E exceeds 2 + 2 * 4 = 10, and steps with momentum are stable below 2 (1 + kMomentum) / 10.
constexpr float kStep = 0.19f;
constexpr float kMomentum = 0.7f;     // of the last step kept: what 16 steps do without it takes 6 (Polyak 1964)
constexpr float kSureHeight = 0.02f;  // of the edge's length: a fold half as free as a tall one
constexpr float kTiny = 1e-20f;

/// Against the gradient of 1/2 (length - wanted)^2 for the end that `to_other` starts from.
inline Vec3 pull(const Vec3& to_other, float wanted) {
  const float length = std::sqrt(dot(to_other, to_other) + kTiny);
  return to_other * (1.0f - wanted / length);
}

void begin(const FoldRelaxation& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t first = 0; first < g.edge_count; first += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - first);
    EdgeBlock block;
    block.gather(g, s.position, s.normal, first, count);
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const std::uint32_t e = first + lane;
      const Vec3 middle = block.curve(lane).middle() + s.fold[e] * s.fold_height[e];
      const float sure = kSureHeight * block.target[lane], h2 = s.fold_height[e] * s.fold_height[e];
      s.scratch.middle.set(e, middle);
      s.scratch.pull.set(e, {});
      s.scratch.half_length[e] = 0.5f * (length(middle - block.a[lane]) + length(middle - block.b[lane]));
      s.scratch.freedom[e] = h2 / (h2 + sure * sure + kTiny);
    }
  }
}

/// What is left of the last step, and the pulls along the halves of each edge.
void pull_halves(const FoldRelaxation& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t begin = 0; begin < g.edge_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - begin);
    Vec3Block a, b, middle, sum;
    float half[kLanes];
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t e = begin + std::min(lane, count - 1);
      a.set(lane, s.position[g.edge_particle[0][e]]), b.set(lane, s.position[g.edge_particle[1][e]]);
      middle.set(lane, s.scratch.middle[e]), half[lane] = s.scratch.half_length[e];
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      sum.set(lane, pull(a[lane] - middle[lane], half[lane]) + pull(b[lane] - middle[lane], half[lane]));
    }
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      s.scratch.pull.set(begin + lane, s.scratch.pull[begin + lane] * kMomentum + sum[lane]);
    }
  }
}

void pull_in_faces(const FoldRelaxation& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t begin = 0; begin < g.face_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - begin);
    Vec3Block middle[3], sum[3];
    float rest[3][kLanes];
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t e = g.face_edge[k][begin + std::min(lane, count - 1)];
        middle[k].set(lane, s.scratch.middle[e]);
        rest[k][lane] = g.edge_rest_curve_length[e];
      }
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Vec3 a = middle[0][lane], b = middle[1][lane], c = middle[2][lane];
      const Vec3 ab = pull(b - a, 0.5f * rest[2][lane]), bc = pull(c - b, 0.5f * rest[0][lane]),
                 ca = pull(a - c, 0.5f * rest[1][lane]);
      sum[0].set(lane, ab - ca), sum[1].set(lane, bc - ab), sum[2].set(lane, ca - bc);
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (std::uint32_t lane = 0; lane < count; ++lane) s.scratch.pull.add(g.face_edge[k][begin + lane], sum[k][lane]);
    }
  }
}

void step(const FoldRelaxation& s) {
  const FoldScratchView& scratch = s.scratch;
  for (std::uint32_t e = 0; e < s.garment->edge_count; ++e) {
    scratch.middle.add(e, scratch.pull[e] * (kStep * scratch.freedom[e]));
  }
}

void finish(const FoldRelaxation& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t first = 0; first < g.edge_count; first += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - first);
    EdgeBlock block;
    block.gather(g, s.position, s.normal, first, count);
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const std::uint32_t e = first + lane;
      if (s.scratch.freedom[e] == 0.0f) continue;
      const Vec3 moved = s.scratch.middle[e] - block.curve(lane).middle();
      s.fold_height[e] = length(moved);
      s.fold.set(e, normalized_or(moved, s.fold[e]));
    }
  }
}

}  // namespace

bool FoldRelaxation::validate() const {
  return sweeps > 0 && garment != nullptr && position.x != nullptr && normal.x != nullptr && fold.x != nullptr &&
         fold_height != nullptr && scratch.middle.x != nullptr && scratch.pull.x != nullptr &&
         scratch.half_length != nullptr && scratch.freedom != nullptr;
}

void FoldRelaxation::run() const {
  begin(*this);
  for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep) {
    pull_halves(*this);
    pull_in_faces(*this);
    step(*this);
  }
  finish(*this);
}

}  // namespace pleat
