// Which features of cloths are near each other, and on which side of each other they belong.
#pragma once

#include <cstdint>

#include "components/column.h"

namespace pleat {

enum class NearKind : std::uint32_t {
  kParticleFace,  // a particle of the first cloth, a face of the second
  kEdges          // an edge of each
};

/// Two features of one cloth, or of two. What a remembered side means is written at `Closeness`.
struct NearPair {
  NearKind kind;
  std::uint32_t first, second;  // cloth-local
  float distance;               // m, to be kept between them
  float side;                   // 1 or -1; 0: not yet known
};

/// Room for pairs: by kind, then in the order of their second features.
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

/// What a grid of up to so many points takes, see PointGrid.
struct GridScratch {
  Column<std::uint32_t> begin, filed;
  Vec3Column point;

  explicit GridScratch(std::pmr::memory_resource* m) : begin(m), filed(m), point(m) {}
  bool holds(std::size_t points) const { return point.size() >= points; }
  void make_room(std::size_t points) {
    if (holds(points)) return;
    begin.resize(2 * points + 2), filed.resize(points), point.resize(points);
  }
};

/// Room for the pairs of the last search, for the edges' middles of the largest cloth, and for a grid of its particles
/// or of these.
struct NearScratch {
  Column<NearPair> pairs;
  Vec3Column middle;
  GridScratch grid;

  explicit NearScratch(std::pmr::memory_resource* m) : pairs(m), middle(m), grid(m) {}
};

}  // namespace pleat
