// Which particles of a cloth are near which of its own faces, and on which side of them.
#pragma once

#include <cstdint>

#include "components/column.h"

namespace pleat {

/// A particle near a face of its own cloth.
struct SelfPair {
  std::uint32_t particle, face;  // cloth-local
  float distance;                // m, to be kept between them
  float side;  // of the face, on which the particle belongs: 1 its front, -1 its back, 0 not yet known
};

/// Room for pairs, in the order of their faces.
struct SelfPairList {
  SelfPair* pairs = nullptr;
  std::uint32_t capacity = 0;
  std::uint32_t* count = nullptr;
};

/// Pairs of the cloth that has them, and the positions for which they were looked for. A cloth whose particles begin at
/// p and that has n owns pairs [kPairsPerParticle p, kPairsPerParticle (p + n)).
struct SelfColumns {
  static constexpr std::uint32_t kPairsPerParticle = 16;

  Column<SelfPair> pairs;
  Vec3Column sought_at;  // m

  explicit SelfColumns(std::pmr::memory_resource* m) : pairs(m), sought_at(m) {}
};

}  // namespace pleat
