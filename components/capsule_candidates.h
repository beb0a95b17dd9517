// What of a cloth may touch which capsule before they have moved much: looked up now and then, tested in each substep.
#pragma once

#include <bit>
#include <cstdint>

#include "components/colliders.h"
#include "components/garment.h"

namespace pleat {

/// A set of a cloth's particles, edges and faces is a bit each, in words of 64; where the words of each kind begin.
struct FeatureWords {
  std::size_t particles = 0, edges, faces, end;

  explicit FeatureWords(const Garment& g)
      : edges(words(g.particle_count)), faces(edges + words(g.edge_count)), end(faces + words(g.face_count)) {}

 private:
  static std::size_t words(std::uint32_t count) { return (std::size_t{count} + 63) / 64; }
};

/// visit(i) for the bits that are set, ascending.
template <class Visitor>
void for_each_bit(const std::uint64_t* begin, const std::uint64_t* end, const Visitor& visit) {
  for (const std::uint64_t* word = begin; word != end; ++word) {
    for (std::uint64_t bits = *word; bits != 0; bits &= bits - 1) {
      visit(static_cast<std::uint32_t>(64 * (word - begin) + std::countr_zero(bits)));
    }
  }
}

/// The candidates of one cloth. They can be relied on while they are of the same capsules and nothing came closer than
/// they allow for, see CapsuleCandidates.
struct CapsuleCandidateColumns {
  Column<std::uint64_t> near;      // a set for each capsule; size() is the room
  Column<CapsulePose> sought;      // the capsules as they were, ascending by index
  Vec3Column anchor;               // (P) m, where particles were
  std::uint32_t sought_count = 0;  // of capsules
  float margin = 0.0f;             // m, what is looked for besides radius and thickness

  explicit CapsuleCandidateColumns(std::pmr::memory_resource* m) : near(m), sought(m), anchor(m) {}
};

}  // namespace pleat
