#include "systems/capsule_detection.h"

#include <algorithm>
#include <bit>

#include "systems/capsule_rows.h"

namespace pleat {
namespace {

/// test(features, used) for eight at a time. The last may be fewer: `used` has a bit for each lane with a feature of
/// its own, the others have the first one's.
template <class Test>
PLEAT_KERNEL void for_each_eight(const CapsuleCandidateColumns& candidates, const NearFeatures& near,
                                 const Test& test) {
  for (std::uint32_t first = 0; first < near.count; first += kLanes) {
    const std::uint32_t used = (1u << std::min(near.count - first, kLanes)) - 1;
    if (near.begin != NearFeatures::kAll) {
      test(candidates.feature.data() + near.begin + first, used);
    } else {
      std::uint32_t feature[kLanes];
      for (std::uint32_t k = 0; k < kLanes; ++k) feature[k] = (used >> k & 1) != 0 ? first + k : first;
      test(feature, used);
    }
  }
}

/// One capsule against one cloth.
struct CapsuleTest {
  const CapsuleDetection& in;
  const ContactRowMaker& maker;
  const CapsulePose& capsule;
  float margin;
  std::uint32_t number;                                          // of the capsule
  float reach = widest_radius(capsule) + in.thickness + margin;  // from the core
  Core lanes = Core(capsule, reach + kLaneRounding);

  PLEAT_KERNEL void run(Stats& stats) const {
    const CapsuleRows rows{maker,   in.packed, in.capsules, in.capsule_count, in.blocks, in.thickness,
                           capsule, lanes,     reach};
    NearPlaces round, flat;
    for_each_eight(*in.candidates, of(FeatureKind::kParticle), [&](const std::uint32_t* particle, std::uint32_t used) {
      find_particles(particle, used, round);
      add_round(rows, round, kLanes, stats);
    });
    for_each_eight(*in.candidates, of(FeatureKind::kEdge), [&](const std::uint32_t* edge, std::uint32_t used) {
      find_edges(edge, used, round);
      add_round(rows, round, kLanes, stats);
    });
    add_round(rows, round, 1, stats);
    for_each_eight(*in.candidates, of(FeatureKind::kFace), [&](const std::uint32_t* face, std::uint32_t used) {
      find_faces(face, used, flat);
      add_flat(rows, flat, kLanes, stats);
    });
    add_flat(rows, flat, 1, stats);
  }

 private:
  /// While there are `least` places.
  static PLEAT_KERNEL void add_round(const CapsuleRows& rows, NearPlaces& places, std::uint32_t least, Stats& stats) {
    while (places.count >= least) {
      rows.add_round(places, places.first_lanes(), stats);
      places.drop_lanes();
    }
  }
  static PLEAT_KERNEL void add_flat(const CapsuleRows& rows, NearPlaces& places, std::uint32_t least, Stats& stats) {
    while (places.count >= least) {
      rows.add_flat(places, places.first_lanes(), stats);
      places.drop_lanes();
    }
  }

  const NearFeatures& of(FeatureKind kind) const { return in.candidates->of(number, kind); }

  /// Where eight features have a corner that is in column `corner`.
  PLEAT_KERNEL Vec3Lanes places(const Column<std::uint32_t>& corner, const std::uint32_t* feature) const {
    std::uint32_t index[kLanes];
    for (std::uint32_t k = 0; k < kLanes; ++k) index[k] = corner.data()[feature[k]];
    return gather(in.packed, index).vector;
  }

  PLEAT_KERNEL void find_particles(const std::uint32_t* particle, std::uint32_t used, NearPlaces& found) const {
    const Vec3Lanes p = gather(in.packed, particle).vector - lanes.a;
    const Lanes t = lanes.axis2 > 0.0f ? clamped(dot(p, lanes.axis) / lanes.axis2) : Lanes{};
    const Vec3Lanes away = p - lanes.axis * t;
    for (std::uint32_t rest = bits(dot(away, away) < lanes.reach2) & used; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      const std::uint32_t i = particle[k];
      found.add(i, i, i, 0.0f, capsule.taper == 0.0f ? t[k] : closest_on_tapered(in.position[i], capsule));
    }
  }

  PLEAT_KERNEL void find_edges(const std::uint32_t* edge, std::uint32_t used, NearPlaces& found) const {
    const auto& end = in.garment->edge_particle;
    const EdgeDistance at_edge(lanes, EdgeLanes(places(end[0], edge), places(end[1], edge)));
    const LaneMask known = capsule.taper == 0.0f ? at_edge.crosses : LaneMask{};
    const LaneMask at_end = (at_edge.s < kEndShare) | (at_edge.s > 1.0f - kEndShare);
    const std::uint32_t good = bits(known);
    for (std::uint32_t rest = bits((at_edge.distance2 < lanes.reach2) & ~(known & at_end)) & used; rest != 0;
         rest &= rest - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      const std::uint32_t i = end[0].data()[edge[k]], j = end[1].data()[edge[k]];
      SegmentPair at{at_edge.s[k], at_edge.t[k]};
      if ((good >> k & 1) == 0) {
        at = closest_to_capsule(in.position[i], in.position[j], capsule);
        if (at.s < kEndShare || at.s > 1.0f - kEndShare) continue;
      }
      found.add(i, j, j, at.s, at.t);
    }
  }

  /// Where an end of the core is over the inside of a face; all other places that are closest belong to its edges.
  PLEAT_KERNEL void find_faces(const std::uint32_t* face, std::uint32_t used, NearPlaces& found) const {
    const auto& corner = in.garment->face_particle;
    const FaceAreas faces(places(corner[0], face), places(corner[1], face), places(corner[2], face));
    const auto [over, other_over] = faces.have_below(lanes.a, lanes.a + lanes.axis, reach);
    const std::uint32_t over_a = bits(over) & used, over_b = capsule.a == capsule.b ? 0 : bits(other_over) & used;
    for (std::uint32_t rest = over_a | over_b; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      const std::uint32_t i[] = {corner[0].data()[face[k]], corner[1].data()[face[k]], corner[2].data()[face[k]]};
      if ((over_a >> k & 1) != 0) found.add(i[0], i[1], i[2], 0.0f, 0.0f);
      if ((over_b >> k & 1) != 0) found.add(i[0], i[1], i[2], 0.0f, 1.0f);
    }
  }
};

}  // namespace

bool CapsuleDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         (capsule_count == 0 || (capsules != nullptr && blocks != nullptr)) && candidates != nullptr &&
         candidates->near.size() >= std::size(kFeatureKinds) * capsule_count && contacts.count != nullptr &&
         packed != nullptr && thickness >= 0.0f && friction >= 0.0f && dt > 0.0f;
}

void CapsuleDetection::run(Stats& stats) const {
  run_wide(widest_vectors(), [&] {
    for (std::uint32_t c = 0; c < capsule_count; ++c) {
      if (c % kLanes == 0) blocks[c / kLanes] = CapsuleBlock{};
      blocks[c / kLanes].put(c % kLanes, capsules[c]);
    }
    pack(position, inverse_mass, garment->particle_count, packed);
    const float margin = contact_margin_in_kernel(position, previous, garment->particle_count);
    const ContactRowMaker maker{previous, inverse_mass, friction, dt, contacts};
    for (std::uint32_t c = 0; c < capsule_count; ++c) {
      const auto has_any = [&](FeatureKind kind) { return candidates->of(c, kind).count != 0; };
      if (std::any_of(std::begin(kFeatureKinds), std::end(kFeatureKinds), has_any)) {
        CapsuleTest{*this, maker, capsules[c], margin, c}.run(stats);
      }
    }
  });
}

}  // namespace pleat
