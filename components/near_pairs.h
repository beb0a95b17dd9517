// Which features of cloths are near each other, and on which side of each other they belong.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "components/lanes.h"

namespace pleat {

struct Garment;

enum class NearKind : std::uint32_t {
  kParticleFace,       // first: a particle, second: a face
  kEdges,              // an edge each
  kOtherParticleFace,  // as the first, but the particle is the other cloth's and the face the own one
};

/// Two features of one cloth, or of two. What a remembered side means is written at `Closeness`.
struct NearPair {
  NearKind kind;
  std::uint32_t first, second;  // cloth-local
  std::uint32_t cloth;          // the other one: its place among the world's; 0 where there is none
  float distance;               // m, to be kept between them
  float side;                   // 1 or -1; 0: not yet known
};

/// Room for pairs: by cloth, kind and second feature.
struct NearPairList {
  NearPair* pairs = nullptr;
  std::uint32_t capacity = 0;
  std::uint32_t* count = nullptr;
};

/// Pairs of the cloth that has them, and the positions for which they were looked for. A cloth whose particles begin at
/// p and that has n owns pairs [kPairsPerParticle p, kPairsPerParticle (p + n)).
struct SelfColumns {
  static constexpr std::uint32_t kPairsPerParticle = 48;

  Column<NearPair> pairs;
  Vec3Column sought_at;  // m

  explicit SelfColumns(std::pmr::memory_resource* m) : pairs(m), sought_at(m) {}
};

/// A cloth as those of higher layers see it: it moves in straight lines over the tick.
struct LayerCloth {
  const Garment* garment = nullptr;
  std::uint32_t layer = 0;
  ConstVec3View begin{}, end{};  // (P) m, when the tick begins and ends
  Vec3 origin{};                 // of these, m in the world
  Vec3 low{}, high{};            // of the box around both, m in the world

  /// Particle i at the fraction t of the tick, as seen from another origin.
  Vec3 at(std::uint32_t i, float t, const Vec3& from) const { return lerp(begin[i], end[i], t) + (origin - from); }
};

/// Some clothes, by their places among the world's, in that order; or too many to be kept.
struct LayersNear {
  static constexpr std::uint32_t kMost = 16;

  std::uint32_t count = 0;  // kMost + 1: too many
  std::uint32_t cloth[kMost] = {};

  bool too_many() const { return count > kMost; }
  std::span<std::uint32_t> kept() { return {cloth, std::min(count, kMost)}; }
  std::span<const std::uint32_t> kept() const { return {cloth, std::min(count, kMost)}; }
  void add(std::uint32_t place) {
    if (count < kMost) cloth[count] = place;
    count = std::min(count + 1, kMost + 1);
  }
  /// Of too many none stays.
  void remove(std::uint32_t place) {
    if (too_many()) count = 0;
    const auto found = std::ranges::find(kept(), place);
    if (found == kept().end()) return;
    std::move(found + 1, kept().end(), found);
    --count;
  }
  bool operator==(const LayersNear& other) const {
    return count == other.count && std::ranges::equal(kept(), other.kept());
  }
};

/// When a cloth last looked for pairs with those below it, and how all have moved since.
struct LayersSought {
  LayersNear near;      // those that were near
  Vec3 motion;          // m, of the cloth in ticks that are over
  float others = 0.0f;  // m, how far one of those near has moved against that in these ticks at most
  float t = 0.0f;       // the fraction of this tick from which on their motion is to be added
  bool cut = false;     // some pairs found no room
};

/// What layers keep; ranges as those of SelfColumns.
struct LayerColumns {
  Column<NearPair> pairs;
  Vec3Column sought_at;        // m
  Vec3Column begin;            // m, where particles were when the tick began
  Column<LayerCloth> clothes;  // all of the world, brought up to date one by one

  explicit LayerColumns(std::pmr::memory_resource* m) : pairs(m), sought_at(m), begin(m), clothes(m) {}
};

/// What a grid of up to so many points takes, see PointGrid.
struct GridScratch {
  Column<std::uint32_t> begin, filed, near;
  Column<Vec4> point;

  explicit GridScratch(std::pmr::memory_resource* m) : begin(m), filed(m), near(m), point(m) {}
  bool holds(std::size_t points) const { return point.size() >= points; }
  void make_room(std::size_t points) {
    if (holds(points)) return;
    begin.resize(2 * points + 2), filed.resize(points), near.resize(points + kLanes), point.resize(points);
  }
};

/// Room for the pairs of the last search, for the edges' middles and the particles of the largest cloth, and for a grid
/// of either.
struct NearScratch {
  Column<NearPair> pairs;
  Vec3Column middle, pose;
  Column<Vec4> half;  // of edges as the grid files them: from the middle to an end, m; and 1 / its length squared, 1/m2
  Column<Vec4> other, other_begin;  // m, of a cloth below at the substep's end and when it began
  GridScratch grid;

  explicit NearScratch(std::pmr::memory_resource* m)
      : pairs(m), middle(m), pose(m), half(m), other(m), other_begin(m), grid(m) {}
  bool holds(std::size_t particles, std::size_t edges) const {
    return middle.size() >= edges && half.size() >= edges && pose.size() >= particles && other.size() >= particles &&
           other_begin.size() >= particles && grid.holds(std::max(particles, edges));
  }
  void make_room(std::size_t particles, std::size_t edges) {
    at_least(middle, edges), at_least(half, edges), at_least(pose, particles);
    at_least(other, particles), at_least(other_begin, particles);
    grid.make_room(std::max(particles, edges));
  }
};

}  // namespace pleat
