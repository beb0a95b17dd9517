#include "systems/fold_sides.h"

#include <algorithm>
#include <cmath>

#include "components/wide.h"

namespace pleat {
namespace {

constexpr int kSweeps = 3;
constexpr float kSureSide = 0.36f;  // dL/dh at h = 0 from which on the first guess is certain
constexpr float kBump = 3.0f;       // energy of a fold as high as its edge is long, beside that of the springs
constexpr float kDecisive = 0.05f;  // difference of energy from which on a side is certain
constexpr float kSideTime = 0.08f;  // s in which a fold goes most of its way to the other side
constexpr float kTiny = 1e-20f;

/// -1 .. 1, smooth up to both ends.
PLEAT_KERNEL Lanes saturate(const Lanes& x) {
  const Lanes y = min(max(x, all(-1.0f)), all(1.0f));
  return y * (1.5f - 0.5f * y * y);
}

PLEAT_KERNEL Lanes height_at(const Lanes& side, const Lanes& up, const Lanes& down) {
  return side * (side > 0.0f ? up : -down);
}

PLEAT_KERNEL void guess(const FoldSides& s) {
  const Garment& g = *s.garment;
  FoldChoices& c = *s.choices;
  for (std::uint32_t e = 0; e < g.edge_count; e += kLanes) {
    const FoldCurve edges(EdgeBlock(g, s.position, s.normal, e));
    c.curves[e / kLanes] = edges;
    const auto& [curve, fold] = edges;
    const auto& [n, defined] = fold;
    const Lanes target = load(g.edge_rest_curve_length.data() + e);
    const Lanes length0 = mean_square_length(curve), slope = -0.5f * dot(curve.u + curve.v, n) / (target + kTiny);
    const Lanes up = defined * fold_height(length0, target, slope).height;
    const Lanes down = -defined * fold_height(length0, target, -slope).height;
    const Lanes side = saturate(slope * (1.0f / kSureSide));
    pack(curve.middle(), load(g.edge_rest_length.data() + e), c.middle.data() + e);
    pack(n, Lanes{}, c.direction.data() + e);
    store(up, c.up.data() + e), store(down, c.down.data() + e);
    store(side, c.side.data() + e), store(height_at(side, up, down), c.height.data() + e);
    store(kBump * (down * down - up * up) / (target * target + kTiny), c.bump.data() + e);
    store(Lanes{}, c.gain.data() + e);
  }
}

PLEAT_KERNEL void span_springs(const FoldSides& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t f = 0; f < g.face_count; f += kLanes) {
    FoldSprings& springs = s.choices->springs[f / kLanes];
    const auto edge = [&](std::size_t k) { return g.face_edge[k].data() + f; };
    const auto middle_of = [&](std::size_t k) { return gather(s.choices->middle.data(), edge(k)); };
    const auto direction_of = [&](std::size_t k) { return gather(s.choices->direction.data(), edge(k)).vector; };
    const Vec4Lanes middle[3] = {middle_of(0), middle_of(1), middle_of(2)};
    const Vec3Lanes direction[3] = {direction_of(0), direction_of(1), direction_of(2)};
    for (std::size_t k = 0; k < 3; ++k) {
      springs.up[k] = gather(s.choices->up.data(), edge(k)), springs.down[k] = gather(s.choices->down.data(), edge(k));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, across = (k + 2) % 3;
      const Lanes unit = 4.0f / (middle[across].w * middle[across].w + kTiny);
      const Vec3Lanes d = middle[k].vector - middle[l].vector;
      springs.stretch[k] = dot(d, d) * unit - 1.0f;
      springs.at_first[k] = dot(d, direction[k]) * unit;
      springs.at_second[k] = dot(d, direction[l]) * unit;
      springs.both[k] = dot(direction[k], direction[l]) * unit;
      springs.unit[k] = unit;
    }
  }
}

/// How much more energy a spring has with its end at `down` than at `up`; base + 2 slope h + unit h^2 is its stretch.
PLEAT_KERNEL Lanes difference(const Lanes& base, const Lanes& slope, const Lanes& unit, const Lanes& up,
                              const Lanes& down) {
  const Lanes at_up = base + up * (2.0f * slope + unit * up), at_down = base + down * (2.0f * slope + unit * down);
  return at_down * at_down - at_up * at_up;
}

PLEAT_KERNEL void ask_springs(const FoldSides& s) {
  const Garment& g = *s.garment;
  FoldChoices& c = *s.choices;
  for (std::uint32_t f = 0; f < g.face_count; f += kLanes) {
    const FoldSprings& springs = c.springs[f / kLanes];
    Lanes height[3], gain[3]{};
    for (std::size_t k = 0; k < 3; ++k) height[k] = gather(c.height.data(), g.face_edge[k].data() + f);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const Lanes &stretch = springs.stretch[k], &first = springs.at_first[k], &second = springs.at_second[k],
                  &both = springs.both[k], &unit = springs.unit[k], &h = height[k], &j = height[l];
      gain[k] +=
          difference(stretch + j * (unit * j - 2.0f * second), first - both * j, unit, springs.up[k], springs.down[k]);
      gain[l] +=
          difference(stretch + h * (unit * h + 2.0f * first), -second - both * h, unit, springs.up[l], springs.down[l]);
    }
    const LaneMask faces = first_lanes(g.face_count - f);
    for (std::size_t k = 0; k < 3; ++k) {
      scatter_add(faces ? gain[k] : Lanes{}, g.face_edge[k].data() + f, kLanes, c.gain.data());
    }
  }
}

PLEAT_KERNEL void decide(const FoldSides& s) {
  FoldChoices& c = *s.choices;
  for (std::uint32_t e = 0; e < s.garment->edge_count; e += kLanes) {
    const Lanes energy = load(c.gain.data() + e) + load(c.bump.data() + e);
    const Lanes side = 0.5f * (load(c.side.data() + e) + saturate(energy * (1.0f / kDecisive)));
    store(side, c.side.data() + e);
    store(height_at(side, load(c.up.data() + e), load(c.down.data() + e)), c.height.data() + e);
    store(Lanes{}, c.gain.data() + e);
  }
}

/// The drawn side follows the choice.
PLEAT_KERNEL void follow(const FoldSides& s) {
  const std::uint32_t edges = s.garment->edge_count;
  for (std::uint32_t e = 0; e < edges; e += kLanes) {
    const Lanes chosen = load(s.choices->side.data() + e);
    const Lanes side = s.kept > 0.0f ? chosen + s.kept * (load(s.side + e) - chosen) : chosen;
    store(side, s.side + e, std::min(kLanes, edges - e));
  }
}

}  // namespace

float FoldSides::kept_after(float dt) { return std::exp(dt * (-1.0f / kSideTime)); }

bool FoldSides::validate() const {
  return garment != nullptr && position.x != nullptr && normal.x != nullptr && side != nullptr && choices != nullptr &&
         choices->holds(garment->edge_count, garment->face_count);
}

void FoldSides::run() const {
  run_wide(widest_vectors(), [this] {
    guess(*this);
    span_springs(*this);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      ask_springs(*this);
      decide(*this);
    }
    follow(*this);
  });
}

}  // namespace pleat
