// What of a cloth may touch which capsule before they have moved much: looked up now and then, tested in each substep.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "components/colliders.h"
#include "components/garment.h"
#include "components/lanes.h"

namespace pleat {

enum class FeatureKind : std::uint8_t { kParticle, kEdge, kFace };
inline constexpr FeatureKind kFeatureKinds[] = {FeatureKind::kParticle, FeatureKind::kEdge, FeatureKind::kFace};

constexpr std::uint32_t count_of(const Garment& g, FeatureKind kind) {
  return kind == FeatureKind::kParticle ? g.particle_count : kind == FeatureKind::kEdge ? g.edge_count : g.face_count;
}

/// Features of one kind near one capsule, ascending: in column `corner` from `begin` on, eight at a time, the first
/// corners of all eight, then their second ones, the last eight filled up with the first feature; or all that there
/// are, where the column had no room.
struct NearFeatures {
  static constexpr std::uint32_t kAll = ~std::uint32_t{0};
  std::uint32_t begin = 0, count = 0;
};

/// The candidates of one cloth. They can be relied on while they are of the same garment and capsules and nothing came
/// closer than they allow for, see CapsuleCandidates.
struct CapsuleCandidateColumns {
  Column<NearFeatures> near;   // of each kind for each capsule; size() is the room
  Column<Vec4Place> corner;    // that these are in, shared out among the capsules in equal parts
  Column<std::uint32_t> end;   // scratch: where in `corner` the lists of each capsule end
  Column<CapsulePose> sought;  // the capsules as they were, ascending by index
  Vec3Column anchor;           // (P) m, where particles were
  Column<float> room;          // (P, padded) for each capsule, m: CapsuleCandidates
  const Garment* garment = nullptr;
  std::uint32_t sought_count = 0;  // of capsules
  float thickness = 0.0f;          // of the cloth, m
  float margin = 0.0f;             // m, what is looked for besides radius and thickness

  explicit CapsuleCandidateColumns(std::pmr::memory_resource* m)
      : near(m), corner(m), end(m), sought(m), anchor(m), room(m) {}

  NearFeatures& of(std::uint32_t capsule, FeatureKind kind) { return near.data()[place(capsule, kind)]; }
  const NearFeatures& of(std::uint32_t capsule, FeatureKind kind) const { return near.data()[place(capsule, kind)]; }

  float* room_of(const Garment& g, std::uint32_t capsule) { return room.data() + capsule * padded(g.particle_count); }

  /// Where in column `corner` the lists of one of `capsules` begin and end.
  std::uint32_t lists_begin(std::uint32_t capsule, std::uint32_t capsules) const {
    return capsule * static_cast<std::uint32_t>(corner.size() / capsules / kLanes * kLanes);
  }
  std::uint32_t lists_end(std::uint32_t capsule, std::uint32_t capsules) const {
    return lists_begin(capsule + 1, capsules);
  }

  /// Forgets what was found: another garment may come to be where this one was.
  void make_room(const Garment& g, std::size_t capsules) {
    const std::size_t corners = padded(g.particle_count) + 2 * padded(g.edge_count) + 3 * padded(g.face_count);
    at_least(near, std::size(kFeatureKinds) * capsules);
    at_least(corner, corners * std::min(capsules, kCapsulesPerFeature));
    at_least(end, capsules);
    at_least(sought, capsules);
    at_least(anchor, g.particle_count);
    at_least(room, padded(g.particle_count) * capsules);
    garment = nullptr;
  }
  bool holds(const Garment& g, std::size_t capsules) const {
    return near.size() >= std::size(kFeatureKinds) * capsules && end.size() >= capsules && sought.size() >= capsules &&
           anchor.size() >= g.particle_count && room.size() >= padded(g.particle_count) * capsules;
  }

 private:
  static constexpr std::size_t kCapsulesPerFeature = 8;  // that there is room for, on average

  static std::size_t place(std::uint32_t capsule, FeatureKind kind) {
    return std::size(kFeatureKinds) * capsule + static_cast<std::size_t>(kind);
  }
};

}  // namespace pleat
