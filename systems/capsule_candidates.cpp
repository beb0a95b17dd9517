#include "systems/capsule_candidates.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "components/wide.h"
#include "systems/capsule_lanes.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// Carries a capsule back to where it was, and the cloth with it: a turn about its end a that takes its axis back
/// where that is within 120 degrees.
struct WayBack {
  Vec3 from, to;   // end a now and then, m
  Vec3 column[3];  // of the turn

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

/// Whether a particle, carried back, is farther from where it was than its room less what is `taken` of that, m.
template <class Carry>
PLEAT_KERNEL bool is_out_of_room(const CapsuleCandidates& in, const float* room, float taken, const Carry& carry) {
  const ConstVec3View anchor = in.candidates->anchor.view();
  const float out = largest(in.garment->particle_count, [&](std::size_t i) {
    const Vec3Lanes motion = carry(load(in.position, i)) - load(anchor, i);
    const Lanes left = max(load(room + i) - taken, Lanes{});
    return dot(motion, motion) <= left * left ? Lanes{} : all(1.0f);  // what is not finite is out too
  });
  return out != 0.0f;
}

/// Whether a feature that is not listed may be near now.
PLEAT_KERNEL bool is_stale(const CapsuleCandidates& in) {
  constexpr float kStraight = 5e-4f, kTurnRounding = 1e-5f;  // m
  const float rest = in.margin + kLaneRounding;
  for (std::uint32_t c = 0; c < in.capsule_count; ++c) {
    const CapsulePose &now = in.capsules[c], &then = in.candidates->sought[c];
    const float* room = in.candidates->room_of(*in.garment, c);
    // Shifted back, the core is off by no more than half of what its ends have moved apart: mostly near enough.
    const Vec3 at_a = then.a - now.a, at_b = then.b - now.b;
    const Vec3Lanes shift = all((at_a + at_b) * 0.5f);
    const float turned = 0.5f * length(at_b - at_a);
    if (!is_out_of_room(in, room, turned + rest, [&](const Vec3Lanes& x) { return x + shift; })) continue;
    if (turned < kStraight) return true;
    const WayBack back(now, then);
    const float taken = length(back.at(now.b) - then.b) + kTurnRounding + rest;
    if (is_out_of_room(in, room, taken, [&](const Vec3Lanes& x) { return back.at(x); })) return true;
  }
  return false;
}

bool same_capsules(const CapsuleCandidates& in) {
  const auto same = [](const CapsulePose& p, const CapsulePose& q) {
    return p.index == q.index && widest_radius(p) == widest_radius(q);
  };
  return in.capsule_count == in.candidates->sought_count &&
         std::equal(in.capsules, in.capsules + in.capsule_count, in.candidates->sought.begin(), same);
}

/// Of a word's features, not to be zeroed before they are made.
template <class Features>
union Room {
  Features places[64 / kLanes];
  Room() {}
};

/// The lists of one kind of features, which have kCorners each, in columns of the garment; particles are their own.
template <std::size_t kCorners>
struct NearLists {
  const CapsuleCandidates& in;
  FeatureKind kind;
  const std::uint32_t* corner[kCorners];

  std::uint32_t corner_of(std::uint32_t feature, std::size_t k) const {
    return kCorners == 1 ? feature : corner[k][feature];
  }

  void begin(std::uint32_t capsule) const {
    in.candidates->of(capsule, kind) = {.begin = in.candidates->end[capsule], .count = 0};
  }
  /// Where the corners of the list are, which becomes one of all features where it has no room for so many more.
  Vec4Place* room_for(std::uint32_t more, std::uint32_t capsule, NearFeatures& list) const {
    if (list.begin == NearFeatures::kAll) return nullptr;
    if (end_of({list.begin, list.count + more}) <= in.candidates->lists_end(capsule, in.capsule_count)) {
      return corners_of(list);
    }
    list.begin = NearFeatures::kAll;
    return nullptr;
  }
  void put(std::uint32_t feature, std::uint32_t n, Vec4Place* corners) const {
    for (std::size_t k = 0; k < kCorners; ++k) corners[place(n, k)] = Vec4Place::of(corner_of(feature, k));
  }
  void finish(std::uint32_t capsule) const {
    NearFeatures& list = in.candidates->of(capsule, kind);
    if (list.begin == NearFeatures::kAll) {
      list.count = count_of(*in.garment, kind);
      return;
    }
    Vec4Place* const corners = corners_of(list);
    for (std::uint32_t n = list.count; n % kLanes != 0; ++n) {
      for (std::size_t k = 0; k < kCorners; ++k) corners[place(n, k)] = corners[place(0, k)];
    }
    in.candidates->end[capsule] = end_of(list);
  }

 private:
  static std::uint32_t end_of(const NearFeatures& list) {
    return list.begin + (list.count + kLanes - 1) / kLanes * static_cast<std::uint32_t>(kLanes * kCorners);
  }
  static std::size_t place(std::uint32_t n, std::size_t k) {
    return n / kLanes * kLanes * kCorners + k * kLanes + n % kLanes;
  }
  Vec4Place* corners_of(const NearFeatures& list) const { return in.candidates->corner.data() + list.begin; }
};

/// Lists one kind of features, 64 at a time; and what is not listed but nearer than kFar leaves its particles that much
/// room. Columns' padding belongs to particle 0.
template <class Features, std::size_t kCorners, class MakeFeatures>
PLEAT_KERNEL void list_near(const NearLists<kCorners>& lists, const MakeFeatures& make) {
  constexpr std::uint32_t kBits = 64;
  const CapsuleCandidates& in = lists.in;
  const std::uint32_t count = count_of(*in.garment, lists.kind);
  for (std::uint32_t c = 0; c < in.capsule_count; ++c) lists.begin(c);
  for (std::uint32_t begin = 0; begin < count; begin += kBits) {
    const std::uint32_t rest = std::min(count - begin, kBits);
    const std::uint64_t used = ~std::uint64_t{0} >> (kBits - rest);
    Room<Features> features;
    for (std::uint32_t k = 0; k < rest; k += kLanes) {
      std::construct_at(features.places + k / kLanes, make(begin + k));
    }
    for (std::uint32_t c = 0; c < in.capsule_count; ++c) {
      const float surface = widest_radius(in.capsules[c]) + in.thickness, within = surface + in.candidates->margin;
      const Core core(in.capsules[c], std::max(within, surface + CapsuleCandidates::kFar));
      float* room = in.candidates->room_of(*in.garment, c);
      float distance2[kBits];
      std::uint64_t far = 0;
      for (std::uint32_t k = 0; k < rest; k += kLanes) {
        const Lanes found2 = distance2_from(core, features.places[k / kLanes]);
        store(found2, distance2 + k);
        far |= std::uint64_t{bits(found2 < core.reach2)} << k;
      }
      far &= used;
      NearFeatures& list = in.candidates->of(c, lists.kind);
      Vec4Place* const listed = lists.room_for(static_cast<std::uint32_t>(std::popcount(far)), c, list);
      std::uint32_t n = list.count;
      for (; far != 0; far &= far - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(far));
        if (distance2[k] < within * within) {
          if (listed != nullptr) lists.put(begin + k, n++, listed);
          continue;
        }
        const float away = std::sqrt(distance2[k]) - surface;
        for (std::size_t corner = 0; corner < kCorners; ++corner) {
          float& left = room[lists.corner_of(begin + k, corner)];
          left = std::min(left, away);
        }
      }
      list.count = n;
    }
  }
  for (std::uint32_t c = 0; c < in.capsule_count; ++c) lists.finish(c);
}

PLEAT_KERNEL Vec3Lanes places(const Vec4* x, const std::uint32_t* corner, std::size_t first) {
  return gather(x, corner + first).vector;
}

PLEAT_KERNEL void list_all(const CapsuleCandidates& in) {
  const Garment& g = *in.garment;
  const Vec4* x = in.packed;
  std::fill_n(in.candidates->room.data(), padded(g.particle_count) * in.capsule_count,
              std::max(in.candidates->margin, CapsuleCandidates::kFar));
  for (std::uint32_t c = 0; c < in.capsule_count; ++c) {
    in.candidates->end[c] = in.candidates->lists_begin(c, in.capsule_count);
  }
  list_near<Vec3Lanes>(NearLists<1>{in, FeatureKind::kParticle, {}},
                       [&](std::size_t i) { return load(in.position, i); });
  const NearLists<2> edges{in, FeatureKind::kEdge, {g.edge_particle[0].data(), g.edge_particle[1].data()}};
  list_near<EdgeLanes>(
      edges, [&](std::size_t e) { return EdgeLanes(places(x, edges.corner[0], e), places(x, edges.corner[1], e)); });
  const auto& corner = g.face_particle;
  const NearLists<3> faces{in, FeatureKind::kFace, {corner[0].data(), corner[1].data(), corner[2].data()}};
  list_near<FaceLanes>(faces, [&](std::size_t f) {
    return FaceLanes(places(x, faces.corner[0], f), places(x, faces.corner[1], f), places(x, faces.corner[2], f));
  });
}

}  // namespace

bool CapsuleCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && packed != nullptr &&
         (capsules != nullptr || capsule_count == 0) && thickness >= 0.0f && margin >= 0.0f && candidates != nullptr &&
         candidates->holds(*garment, capsule_count);
}

void CapsuleCandidates::run() const {
  run_wide(widest_vectors(), [this] {
    CapsuleCandidateColumns& out = *candidates;
    const std::uint32_t count = garment->particle_count;
    const bool stale = out.garment != garment || out.thickness != thickness || !same_capsules(*this) || is_stale(*this);
    if (!stale) return;

    for (std::uint32_t i = 0; i < count; i += kLanes) store(load(position, i), out.anchor.view(), i);
    std::copy_n(capsules, capsule_count, out.sought.begin());
    out.garment = garment, out.sought_count = capsule_count, out.thickness = thickness;
    out.margin = margin + kSkin + kLaneRounding;
    list_all(*this);
  });
}

}  // namespace pleat
