#include "systems/fold_sides.h"

#include <algorithm>
#include <cmath>

#include "components/edge_block.h"
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
inline float saturate(float x) {
  const float y = x < -1.0f ? -1.0f : x > 1.0f ? 1.0f : x;
  return y * (1.5f - 0.5f * y * y);
}

inline float height_at(float side, float up, float down) { return side * (side > 0.0f ? up : -down); }

inline FoldChoice first_guess(const PnEdge& c, const Vec3& normals, float target) {
  const auto [n, defined] = fold_direction(c.middle_tangent(), normals);
  const float slope = -0.5f * dot(c.u + c.v, n) / (target + kTiny), length0 = mean_square_length(c);
  const float up = defined * fold_height(length0, target, slope).height;
  const float down = -defined * fold_height(length0, target, -slope).height;
  const float side = saturate(slope * (1.0f / kSureSide));
  const float bump = kBump * (down * down - up * up) / (target * target + kTiny);
  return {c.middle(), n, up, down, side, height_at(side, up, down), bump, 0.0f};
}

void guess(const FoldSides& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t begin = 0; begin < g.edge_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - begin);
    EdgeBlock block;
    FoldChoice choice[kLanes];
    block.gather(g, s.position, s.normal, begin, count);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      choice[lane] = first_guess(block.curve(lane), block.na[lane] + block.nb[lane], block.target[lane]);
    }
    std::copy_n(choice, count, s.choices.begin() + begin);
  }
}

void span_springs(const FoldSides& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t begin = 0; begin < g.face_count; begin += kLanes) {
    FoldSprings& springs = s.springs[begin / kLanes];
    Vec3Block middle[3], direction[3];
    float rest[3][kLanes];
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t f = std::min(begin + lane, g.face_count - 1);
      for (std::size_t k = 0; k < 3; ++k) {
        const FoldChoice& choice = s.choices[g.face_edge[k][f]];
        middle[k].set(lane, choice.middle), direction[k].set(lane, choice.direction);
        rest[k][lane] = g.edge_rest_length[g.face_edge[k][f]];
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, across = (k + 2) % 3;
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const float unit = 4.0f / (rest[across][lane] * rest[across][lane] + kTiny);
        const Vec3 d = middle[k][lane] - middle[l][lane], m = direction[k][lane], n = direction[l][lane];
        springs.stretch[k][lane] = dot(d, d) * unit - 1.0f;
        springs.at_first[k][lane] = dot(d, m) * unit;
        springs.at_second[k][lane] = dot(d, n) * unit;
        springs.both[k][lane] = dot(m, n) * unit;
        springs.unit[k][lane] = unit;
      }
    }
  }
}

/// How much more energy a spring has with its end at `down` than at `up`; base + 2 slope h + unit h^2 is its stretch.
inline float difference(float base, float slope, float unit, float up, float down) {
  const float at_up = base + up * (2.0f * slope + unit * up), at_down = base + down * (2.0f * slope + unit * down);
  return at_down * at_down - at_up * at_up;
}

void ask_springs(const FoldSides& s) {
  const Garment& g = *s.garment;
  for (std::uint32_t begin = 0; begin < g.face_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - begin);
    const FoldSprings& springs = s.springs[begin / kLanes];
    alignas(32) float height[3][kLanes], up[3][kLanes], down[3][kLanes], gain[3][kLanes] = {};
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t f = std::min(begin + lane, g.face_count - 1);
      for (std::size_t k = 0; k < 3; ++k) {
        const FoldChoice& choice = s.choices[g.face_edge[k][f]];
        height[k][lane] = choice.height, up[k][lane] = choice.up, down[k][lane] = choice.down;
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const float stretch = springs.stretch[k][lane], first = springs.at_first[k][lane],
                    second = springs.at_second[k][lane], both = springs.both[k][lane], unit = springs.unit[k][lane];
        const float h = height[k][lane], j = height[l][lane];
        gain[k][lane] +=
            difference(stretch + j * (unit * j - 2.0f * second), first - both * j, unit, up[k][lane], down[k][lane]);
        gain[l][lane] +=
            difference(stretch + h * (unit * h + 2.0f * first), -second - both * h, unit, up[l][lane], down[l][lane]);
      }
    }
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      for (std::size_t k = 0; k < 3; ++k) s.choices[g.face_edge[k][begin + lane]].gain += gain[k][lane];
    }
  }
}

void decide(const FoldSides& s) {
  for (FoldChoice& c : s.choices.first(s.garment->edge_count)) {
    c.side = 0.5f * (c.side + saturate((c.gain + c.bump) * (1.0f / kDecisive)));
    c.height = height_at(c.side, c.up, c.down);
    c.gain = 0.0f;
  }
}

}  // namespace

float FoldSides::kept_after(float dt) { return std::exp(dt * (-1.0f / kSideTime)); }

bool FoldSides::validate() const {
  return garment != nullptr && position.x != nullptr && normal.x != nullptr && side != nullptr &&
         choices.size() >= garment->edge_count && springs.size() * kLanes >= garment->face_count;
}

void FoldSides::run() const {
  run_wide(widest_vectors(), [this] {
    guess(*this);
    span_springs(*this);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      ask_springs(*this);
      decide(*this);
    }
    for (std::uint32_t e = 0; e < garment->edge_count; ++e) {
      side[e] = kept > 0.0f ? choices[e].side + kept * (side[e] - choices[e].side) : choices[e].side;
    }
  });
}

}  // namespace pleat
