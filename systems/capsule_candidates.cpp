#include "systems/capsule_candidates.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "components/wide.h"
#include "systems/box.h"
#include "systems/capsule_lanes.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// Carries a capsule back to where it was, and the cloth with it: a turn about its end a that takes its axis back
/// where that is within 120 degrees.
struct WayBack {
  Vec3 from, to;      // end a now and then, m
  Vec3 column[3];     // of the turn
  float left = 0.0f;  // of the motion of end b, m

  static constexpr float kRounding = 1e-5f;  // m

  WayBack(const CapsulePose& now, const CapsulePose& then) : from(now.a), to(then.a) {
    const Vec3 axis = normalized_or(now.b - now.a, {}), old_axis = normalized_or(then.b - then.a, {});
    const float cosine = dot(axis, old_axis);
    const Vec3 turn = cosine > -0.5f ? cross(axis, old_axis) : Vec3{};
    // 1 + [turn] + [turn]^2 / (1 + cosine), where [turn] x = turn cross x
    const Vec3 unit[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 3; ++k) {
      const Vec3 across = cross(turn, unit[k]);
      column[k] = unit[k] + across + cross(turn, across) * (1.0f / std::max(1.0f + cosine, 0.5f));
    }
    left = length(at(now.b) - then.b) + kRounding;
  }
  Vec3 at(const Vec3& p) const {
    const Vec3 q = p - from;
    return to + column[0] * q.x + column[1] * q.y + column[2] * q.z;
  }
  PLEAT_KERNEL Vec3Lanes at(const Vec3Lanes& p) const {
    const Vec3Lanes q = p - all(from);
    return all(to) + all(column[0]) * q.x + all(column[1]) * q.y + all(column[2]) * q.z;
  }
};

/// The farthest that a particle has moved against the ends of a core, and so against any of it, squared, m2.
PLEAT_KERNEL float motion2_against(const CapsuleCandidates& in, const CapsulePose& now, const CapsulePose& then) {
  const ConstVec3View anchor = in.candidates->anchor.view();
  const Vec3Lanes of_a = all(now.a - then.a), of_b = all(now.b - then.b);
  return largest(in.garment->particle_count, [&](std::size_t i) {
    const Vec3Lanes motion = load(in.position, i) - load(anchor, i), a = motion - of_a, b = motion - of_b;
    return max(dot(a, a), dot(b, b));
  });
}

/// Whether a feature that was not near a capsule may be near it now. As long as the corners of a feature have moved
/// against the core by no more than `skin`, it is not; nor as long as they have moved by no more than they were too far
/// away, each less the longest edge, for no point of the feature was farther from them than that.
PLEAT_KERNEL bool may_be_near(const CapsuleCandidates& in, const CapsulePose& now, const CapsulePose& then, float skin,
                              float margin) {
  const ConstVec3View anchor = in.candidates->anchor.view();
  const WayBack back(now, then);
  const float most = skin - back.left;
  if (!(most >= 0.0f)) return true;
  const float reach = std::max(widest_radius(now), widest_radius(then)) + in.thickness + margin + kLaneRounding;
  const Core core(then, 0.0f);
  for (std::uint32_t i = 0; i < in.garment->particle_count; i += kLanes) {
    const Vec3Lanes at = load(anchor, i), motion = back.at(load(in.position, i)) - at;
    const Lanes motion2 = dot(motion, motion);
    LaneMask beyond = ~(motion2 <= most * most) & first_lanes(in.garment->particle_count - i);
    if (!any(beyond)) continue;
    const Lanes room = length(away_from(core, at)) - (in.candidates->longest_edge + reach + back.left);
    beyond &= ~((room > 0.0f) & (motion2 <= room * room));
    if (any(beyond)) return true;
  }
  return false;
}

PLEAT_KERNEL bool is_stale(const CapsuleCandidates& in, float margin) {
  const float skin = in.candidates->margin - kLaneRounding - margin;
  if (!(skin >= 0.0f)) return true;
  for (std::uint32_t c = 0; c < in.capsule_count; ++c) {
    const CapsulePose &now = in.capsules[c], &then = in.candidates->sought[c];
    if (!(motion2_against(in, now, then) <= skin * skin) && may_be_near(in, now, then, skin, margin)) return true;
  }
  return false;
}

bool same_capsules(const CapsuleCandidates& in) {
  const auto same = [](const CapsulePose& p, const CapsulePose& q) { return p.index == q.index; };
  return in.capsule_count == in.candidates->sought_count &&
         std::equal(in.capsules, in.capsules + in.capsule_count, in.candidates->sought.begin(), same);
}

/// Of a word's features, not to be zeroed before they are made.
template <class Features>
union Room {
  Features places[64 / kLanes];
  Room() {}
};

/// Marks one kind of features, which begin at `word` of each capsule's set, a word at a time. Columns' padding belongs
/// to particle 0.
template <class Features, class MakeFeatures>
PLEAT_KERNEL void mark_near(const CapsuleCandidates& in, std::size_t word, std::uint32_t count,
                            const MakeFeatures& make) {
  constexpr std::uint32_t kBits = 64;
  const std::size_t words = FeatureWords(*in.garment).end;
  for (std::uint32_t begin = 0; begin < count; begin += kBits) {
    const std::uint32_t rest = std::min(count - begin, kBits);
    const std::uint64_t used = ~std::uint64_t{0} >> (kBits - rest);
    Room<Features> room;
    Features* features = room.places;
    for (std::uint32_t k = 0; k < rest; k += kLanes) std::construct_at(features + k / kLanes, make(begin + k));
    std::uint64_t* at = in.candidates->marked.data() + word + begin / kBits;
    for (std::uint32_t c = 0; c < in.capsule_count; ++c, at += words) {
      const Core core(in.capsules[c], widest_radius(in.capsules[c]) + in.thickness + in.candidates->margin);
      std::uint64_t marks = 0;
      for (std::uint32_t k = 0; k < rest; k += kLanes) {
        marks |= std::uint64_t{bits(is_near(core, features[k / kLanes]))} << k;
      }
      *at = marks & used;
    }
  }
}

PLEAT_KERNEL void mark_all(const CapsuleCandidates& in) {
  const Garment& g = *in.garment;
  const FeatureWords words(g);
  const Vec4* x = in.packed;
  const auto places = [x](const Column<std::uint32_t>& corner, std::size_t first) {
    return gather(x, corner.data() + first).vector;
  };
  Lanes longest2{};
  mark_near<Vec3Lanes>(in, words.particles, g.particle_count, [&](std::size_t i) { return load(in.position, i); });
  mark_near<EdgeLanes>(in, words.edges, g.edge_count, [&](std::size_t e) {
    const EdgeLanes edges(places(g.edge_particle[0], e), places(g.edge_particle[1], e));
    longest2 = max(dot(edges.along, edges.along), longest2);
    return edges;
  });
  mark_near<FaceLanes>(in, words.faces, g.face_count, [&](std::size_t f) {
    return FaceLanes(places(g.face_particle[0], f), places(g.face_particle[1], f), places(g.face_particle[2], f));
  });
  in.candidates->longest_edge = std::sqrt(largest(longest2));
}

/// Of the sets that are marked.
void list_all(const CapsuleCandidates& in) {
  CapsuleCandidateColumns& out = *in.candidates;
  const FeatureWords words(*in.garment);
  const std::size_t first_word[] = {words.particles, words.edges, words.faces, words.end};
  const std::uint64_t* marked = out.marked.data();
  std::uint32_t* feature = out.feature.data();
  std::uint32_t used = 0;
  for (std::uint32_t c = 0; c < in.capsule_count; ++c, marked += words.end) {
    for (const FeatureKind kind : kFeatureKinds) {
      const std::uint64_t* begin = marked + first_word[static_cast<std::size_t>(kind)];
      const std::uint64_t* end = marked + first_word[static_cast<std::size_t>(kind) + 1];
      NearFeatures& near = out.of(c, kind);
      near = {.begin = used, .count = 0};
      for (const std::uint64_t* word = begin; word != end; ++word) {
        near.count += static_cast<std::uint32_t>(std::popcount(*word));
      }
      const std::uint32_t whole_lanes = (near.count + kLanes - 1) / kLanes * kLanes;
      if (used + whole_lanes > out.feature.size()) {
        near = {.begin = NearFeatures::kAll, .count = count_of(*in.garment, kind)};
        continue;
      }
      for (const std::uint64_t* word = begin; word != end; ++word) {
        const auto first = static_cast<std::uint32_t>(64 * (word - begin));
        for (std::uint64_t rest = *word; rest != 0; rest &= rest - 1) {
          feature[used++] = first + static_cast<std::uint32_t>(std::countr_zero(rest));
        }
      }
      for (; used != near.begin + whole_lanes; ++used) feature[used] = feature[near.begin];
    }
  }
}

}  // namespace

bool CapsuleCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr &&
         (capsules != nullptr || capsule_count == 0) && thickness >= 0.0f && packed != nullptr &&
         candidates != nullptr && candidates->holds(*garment, capsule_count);
}

void CapsuleCandidates::run() const {
  run_wide(widest_vectors(), [this] {
    CapsuleCandidateColumns& out = *candidates;
    const std::uint32_t count = garment->particle_count;
    const float margin = contact_margin_in_kernel(position, previous, count);
    const bool stale = first || !same_capsules(*this) || is_stale(*this, margin);
    if (!stale) return;

    for (std::uint32_t i = 0; i < count; i += kLanes) store(load(position, i), out.anchor.view(), i);
    std::copy_n(capsules, capsule_count, out.sought.begin());
    out.sought_count = capsule_count;
    out.margin = margin + kSkin + kLaneRounding;
    pack(position, nullptr, count, packed);
    mark_all(*this);
    list_all(*this);
  });
}

}  // namespace pleat
