#include "systems/fold_relaxation.h"

#include <algorithm>

#include "components/edge_block.h"
#include "components/wide.h"

namespace pleat {
namespace {

// An edge's middle is the end of 2 halves and of up to 4 segments in faces, whose other ends move too: no curvature of
// E exceeds 2 + 2 * 4 = 10, and steps with momentum are stable below 2 (1 + kMomentum) / 10.
constexpr float kStep = 0.19f;
constexpr float kMomentum = 0.7f;     // of the last step kept: what 16 steps do without it takes 6 (Polyak 1964)
constexpr float kSureHeight = 0.02f;  // of the edge's length: a fold half as free as a tall one
constexpr float kTiny = 1e-20f;

/// Against the gradient of 1/2 (length - wanted)^2 for the end that `to_other` starts from.
PLEAT_KERNEL Vec3Lanes pull(const Vec3Lanes& to_other, const Lanes& wanted) {
  return to_other * (1.0f - wanted / sqrt(dot(to_other, to_other) + kTiny));
}

PLEAT_KERNEL Vec3Lanes folds(const FoldRelaxation& s, std::uint32_t e) {
  return load(s.fold, e) * load(s.fold_height + e);
}

PLEAT_KERNEL void begin(const FoldRelaxation& s) {
  for (std::uint32_t e = 0; e < s.garment->edge_count; e += kLanes) {
    const EdgeBlock block(*s.garment, s.position, s.normal, e);
    const Vec3Lanes middle = block.curve().middle() + folds(s, e);
    const Lanes sure = kSureHeight * load(s.garment->edge_rest_curve_length.data() + e);
    const Lanes height = load(s.fold_height + e), h2 = height * height;
    store(middle, s.scratch.middle, e);
    store(Vec3Lanes{}, s.scratch.pull, e);
    store(0.5f * (length(middle - block.a) + length(middle - block.b)), s.scratch.half_length + e);
    store(h2 / (h2 + sure * sure + kTiny), s.scratch.freedom + e);
  }
}

/// What is left of the last step, and the pulls along the halves of each edge.
PLEAT_KERNEL void pull_halves(const FoldRelaxation& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t e = 0; e < g.edge_count; e += kLanes) {
    const Vec3Lanes a = gather(s.position, g.edge_particle[0].data() + e),
                    b = gather(s.position, g.edge_particle[1].data() + e), middle = load(s.scratch.middle, e);
    const Lanes half = load(s.scratch.half_length + e);
    store(load(s.scratch.pull, e) * kMomentum + (pull(a - middle, half) + pull(b - middle, half)), s.scratch.pull, e);
  }
}

PLEAT_KERNEL void pull_in_faces(const FoldRelaxation& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t f = 0; f < g.face_count; f += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - f);
    Vec3Lanes middle[3];
    Lanes rest[3];
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] = gather(s.scratch.middle, g.face_edge[k].data() + f);
      rest[k] = gather(g.edge_rest_curve_length.data(), g.face_edge[k].data() + f);
    }
    const auto& [a, b, c] = middle;
    const Vec3Lanes ab = pull(b - a, 0.5f * rest[2]), bc = pull(c - b, 0.5f * rest[0]),
                    ca = pull(a - c, 0.5f * rest[1]);
    const Vec3Lanes sum[3] = {ab - ca, bc - ab, ca - bc};
    for (std::size_t k = 0; k < 3; ++k) scatter_add(sum[k], g.face_edge[k].data() + f, count, s.scratch.pull);
  }
}

PLEAT_KERNEL void step(const FoldRelaxation& s) {
  const FoldScratchView& scratch = s.scratch;
  for (std::uint32_t e = 0; e < s.garment->edge_count; e += kLanes) {
    const Vec3Lanes moved = load(scratch.pull, e) * (kStep * load(scratch.freedom + e));
    store(load(scratch.middle, e) + moved, scratch.middle, e);
  }
}

PLEAT_KERNEL void finish(const FoldRelaxation& s) {
  const std::uint32_t edges = s.garment->edge_count;
  for (std::uint32_t e = 0; e < edges; e += kLanes) {
    const EdgeBlock block(*s.garment, s.position, s.normal, e);
    const Vec3Lanes moved = load(s.scratch.middle, e) - block.curve().middle(), was = load(s.fold, e);
    const LaneMask free = load(s.scratch.freedom + e) != 0.0f;
    const std::uint32_t count = std::min(kLanes, edges - e);
    store(free ? length(moved) : load(s.fold_height + e), s.fold_height + e, count);
    store(choose(free, normalized_or(moved, was), was), s.fold, e, count);
  }
}

}  // namespace

bool FoldRelaxation::validate() const {
  return sweeps > 0 && garment != nullptr && position.x != nullptr && normal.x != nullptr && fold.x != nullptr &&
         fold_height != nullptr && scratch.middle.x != nullptr && scratch.pull.x != nullptr &&
         scratch.half_length != nullptr && scratch.freedom != nullptr;
}

void FoldRelaxation::run() const {
  run_wide(widest_vectors(), [this] {
    begin(*this);
    for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep) {
      pull_halves(*this);
      pull_in_faces(*this);
      step(*this);
    }
    finish(*this);
  });
}

}  // namespace pleat
