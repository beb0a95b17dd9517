#include "systems/capsule_detection.h"

#include <algorithm>
#include <bit>

#include "systems/capsule_rows.h"

namespace pleat {
namespace {

/// test(corners, used) for eight features at a time. The last may be fewer: `used` has a bit for each lane with a
/// feature of its own, the others have the corners of the first. `corner`: the garment's columns, or of particles,
/// which are their own corners, nullptr.
template <std::size_t kCorners, class Test>
PLEAT_KERNEL void for_each_eight(const CapsuleCandidateColumns& candidates, const NearFeatures& near,
                                 const std::uint32_t* const (&corner)[kCorners], const Test& test) {
  for (std::uint32_t first = 0; first < near.count; first += kLanes) {
    const std::uint32_t used = (1u << std::min(near.count - first, kLanes)) - 1;
    if (near.begin != NearFeatures::kAll) {
      test(candidates.corner.data() + near.begin + kCorners * first, used);
    } else {
      Vec4Place place[kCorners * kLanes];
      for (std::uint32_t k = 0; k < kCorners * kLanes; ++k) {
        const std::uint32_t lane = k % kLanes, feature = (used >> lane & 1) != 0 ? first + lane : first;
        const std::uint32_t* column = corner[k / kLanes];
        place[k] = Vec4Place::of(column == nullptr ? feature : column[feature]);
      }
      test(place, used);
    }
  }
}

/// One capsule against one cloth.
struct CapsuleTest {
  const CapsuleDetection& in;
  const CapsulePose& capsule;
  std::uint32_t number;  // of the capsule
  VectorSet set;
  float reach = widest_radius(capsule) + in.thickness + in.margin;  // from the core
  Core lanes = Core(capsule, reach + kLaneRounding);

  PLEAT_KERNEL void run(Stats& stats) const {
    const CapsuleRows rows{.position = in.position,
                           .previous = in.previous,
                           .capsules = in.capsules,
                           .capsule_count = in.capsule_count,
                           .blocks = in.blocks,
                           .thickness = in.thickness,
                           .friction = in.friction,
                           .dt = in.dt,
                           .contacts = in.contacts,
                           .capsule = capsule,
                           .core = lanes,
                           .reach = reach};
    const Garment& g = *in.garment;
    const std::uint32_t* const itself[] = {nullptr};
    const std::uint32_t* const end[] = {g.edge_particle[0].data(), g.edge_particle[1].data()};
    const std::uint32_t* const corner[] = {g.face_particle[0].data(), g.face_particle[1].data(),
                                           g.face_particle[2].data()};
    NearPlaces round, flat;
    for_each_eight(*in.candidates, of(FeatureKind::kParticle), itself,
                   [&](const Vec4Place* at, std::uint32_t used) PLEAT_KERNEL_LAMBDA {
                     find_particles(at, used, round);
                     add_round(rows, round, kLanes, stats);
                   });
    for_each_eight(*in.candidates, of(FeatureKind::kEdge), end,
                   [&](const Vec4Place* at, std::uint32_t used) PLEAT_KERNEL_LAMBDA {
                     find_edges(at, used, round);
                     add_round(rows, round, kLanes, stats);
                   });
    add_round(rows, round, 1, stats);
    for_each_eight(*in.candidates, of(FeatureKind::kFace), corner,
                   [&](const Vec4Place* at, std::uint32_t used) PLEAT_KERNEL_LAMBDA {
                     find_faces(at, used, flat);
                     add_flat(rows, flat, kLanes, stats);
                   });
    add_flat(rows, flat, 1, stats);
  }

 private:
  /// While there are `least` places. Rows are made out of line: compiled in at each call they would be most of the
  /// library.
  PLEAT_KERNEL void add_round(const CapsuleRows& rows, NearPlaces& places, std::uint32_t least, Stats& stats) const {
    while (places.count >= least) {
      run_wide(set, [&]() PLEAT_KERNEL_LAMBDA { rows.add_round(places, places.first_lanes(), stats); });
      places.drop_lanes();
    }
  }
  PLEAT_KERNEL void add_flat(const CapsuleRows& rows, NearPlaces& places, std::uint32_t least, Stats& stats) const {
    while (places.count >= least) {
      run_wide(set, [&]() PLEAT_KERNEL_LAMBDA { rows.add_flat(places, places.first_lanes(), stats); });
      places.drop_lanes();
    }
  }

  const NearFeatures& of(FeatureKind kind) const { return in.candidates->of(number, kind); }

  /// Where eight features have corner k.
  PLEAT_KERNEL Vec3Lanes place(const Vec4Place* corners, std::uint32_t k) const {
    return gather(in.position, corners + k * kLanes).vector;
  }

  PLEAT_KERNEL void find_particles(const Vec4Place* particle, std::uint32_t used, NearPlaces& found) const {
    const Vec3Lanes p = place(particle, 0) - lanes.a;
    const Lanes t = lanes.axis2 > 0.0f ? clamped(dot(p, lanes.axis) / lanes.axis2) : Lanes{};
    const Vec3Lanes away = p - lanes.axis * t;
    for (std::uint32_t rest = bits(dot(away, away) < lanes.reach2) & used; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      const Vec4Place i = particle[k];
      found.add(i, i, i, 0.0f,
                capsule.taper == 0.0f ? t[k] : closest_on_tapered(vector_of(at(in.position, i)), capsule));
    }
  }

  PLEAT_KERNEL void find_edges(const Vec4Place* end, std::uint32_t used, NearPlaces& found) const {
    const EdgeDistance at_edge(lanes, EdgeLanes(place(end, 0), place(end, 1)));
    const LaneMask known = capsule.taper == 0.0f ? at_edge.crosses : LaneMask{};
    const LaneMask at_end = (at_edge.s < kEndShare) | (at_edge.s > 1.0f - kEndShare);
    const std::uint32_t good = bits(known);
    for (std::uint32_t rest = bits((at_edge.distance2 < lanes.reach2) & ~(known & at_end)) & used; rest != 0;
         rest &= rest - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      const Vec4Place i = end[k], j = end[kLanes + k];
      SegmentPair closest{at_edge.s[k], at_edge.t[k]};
      if ((good >> k & 1) == 0) {
        closest = closest_to_capsule(vector_of(at(in.position, i)), vector_of(at(in.position, j)), capsule);
        if (closest.s < kEndShare || closest.s > 1.0f - kEndShare) continue;
      }
      found.add(i, j, j, closest.s, closest.t);
    }
  }

  /// Where an end of the core is over the inside of a face; all other places that are closest belong to its edges.
  PLEAT_KERNEL void find_faces(const Vec4Place* corner, std::uint32_t used, NearPlaces& found) const {
    const FaceAreas faces(place(corner, 0), place(corner, 1), place(corner, 2));
    const auto [over, other_over] = faces.have_below(lanes.a, lanes.a + lanes.axis, reach);
    const std::uint32_t over_a = bits(over) & used, over_b = capsule.a == capsule.b ? 0 : bits(other_over) & used;
    for (std::uint32_t rest = over_a | over_b; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      const Vec4Place i = corner[k], j = corner[kLanes + k], l = corner[2 * kLanes + k];
      if ((over_a >> k & 1) != 0) found.add(i, j, l, 0.0f, 0.0f);
      if ((over_b >> k & 1) != 0) found.add(i, j, l, 0.0f, 1.0f);
    }
  }
};

}  // namespace

bool CapsuleDetection::validate() const {
  return garment != nullptr && position != nullptr && previous != nullptr &&
         (capsule_count == 0 || (capsules != nullptr && blocks != nullptr)) && candidates != nullptr &&
         candidates->near.size() >= std::size(kFeatureKinds) * capsule_count && contacts.count != nullptr &&
         thickness >= 0.0f && margin >= 0.0f && friction >= 0.0f && dt > 0.0f;
}

void CapsuleDetection::run(Stats& stats) const {
  const VectorSet set = widest_vectors();
  run_wide(set, [&] {
    for (std::uint32_t c = 0; c < capsule_count; ++c) {
      if (c % kLanes == 0) blocks[c / kLanes] = CapsuleBlock{};
      blocks[c / kLanes].put(c % kLanes, capsules[c]);
    }
    for (std::uint32_t c = 0; c < capsule_count; ++c) {
      const auto has_any = [&](FeatureKind kind) { return candidates->of(c, kind).count != 0; };
      if (std::any_of(std::begin(kFeatureKinds), std::end(kFeatureKinds), has_any)) {
        CapsuleTest{*this, capsules[c], c, set}.run(stats);
      }
    }
  });
}

}  // namespace pleat
