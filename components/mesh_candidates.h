// What of a cloth may touch what of the mesh bodies before the tick is over: looked up once, measured in each substep.
#pragma once

#include <bit>
#include <cstdint>

#include "components/column.h"

namespace pleat {

/// A face of the cloth and a triangle of a body, and which of their features may come near.
struct MeshCandidate {
  std::uint32_t mesh, face, triangle;
  std::uint32_t features;  // bits: 0..2 corner c of the face to the triangle; 3..5 the face to corner k of the
                           // triangle; 6 + 3 c + k edge c of the face to edge k of the triangle

  static constexpr std::uint32_t kParticles = 7;
  static constexpr std::uint32_t particle(std::size_t c) { return 1u << c; }
  static constexpr std::uint32_t vertex(int k) { return 8u << k; }
  static constexpr std::uint32_t edges(std::size_t c, int k) { return 64u << (3 * c + static_cast<std::size_t>(k)); }

  enum class Kind { kParticle, kVertex, kEdges };
  struct Feature {
    Kind kind;
    std::size_t of_face;
    int of_body;
  };
  /// The lowest of the bits, which are not all zero.
  static constexpr Feature first(std::uint32_t bits) {
    const int bit = std::countr_zero(bits);
    if (bit < 3) return {Kind::kParticle, static_cast<std::size_t>(bit), 0};
    if (bit < 6) return {Kind::kVertex, 0, bit - 3};
    return {Kind::kEdges, static_cast<std::size_t>(bit - 6) / 3, (bit - 6) % 3};
  }
};

/// The candidates of one cloth, sorted by mesh and face, and how far they can be relied on: while each particle i is
/// within `slack` of anchor_i + drift_i (t - t_anchor), t being the fraction of the tick.
struct MeshCandidateColumns {
  Column<MeshCandidate> pairs;  // [0, count); size() is the room
  std::uint32_t count = 0;
  bool complete = false;  // false: there was no room for all, they are of no use
  Vec3Column anchor;      // (P) m
  Vec3Column drift;       // (P) m a tick
  float t_anchor = 0.0f;
  float reach = 0.0f;  // m, up to which features are wanted of a body that keeps nothing besides

  explicit MeshCandidateColumns(std::pmr::memory_resource* m) : pairs(m), anchor(m), drift(m) {}
};

}  // namespace pleat
