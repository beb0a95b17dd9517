#include "systems/capsule_detection.h"

#include <algorithm>
#include <bit>

#include "systems/capsule_rows.h"

namespace pleat {
namespace {

/// The bits that are set from `begin` on, eight at a time: test(features, used). The last may be fewer; `used` has a
/// bit for each place with a feature of its own.
template <class Test>
PLEAT_KERNEL void for_each_eight(const std::uint64_t* begin, const std::uint64_t* end, const Test& test) {
  constexpr std::uint32_t kBits = 64, kRoom = 4 * kBits;
  std::uint32_t feature[kRoom + kLanes], count = 0;
  for (const std::uint64_t* word = begin; word != end; ++word) {
    const auto first = kBits * static_cast<std::uint32_t>(word - begin);
    for (std::uint64_t rest = *word; rest != 0; rest &= rest - 1) {
      feature[count++] = first + static_cast<std::uint32_t>(std::countr_zero(rest));
    }
    const bool last = word + 1 == end;
    if (!last && count <= kRoom - kBits) continue;
    std::uint32_t k = 0;
    for (; k + kLanes <= count; k += kLanes) test(feature + k, (1u << kLanes) - 1);
    if (last && k != count)
      std::fill_n(feature + count, kLanes, feature[k]), test(feature + k, (1u << (count - k)) - 1);
    std::copy(feature + k, feature + count, feature);
    count -= k;
  }
}

/// One capsule against one cloth.
struct CapsuleTest {
  const CapsuleDetection& in;
  const ContactRowMaker& maker;
  const CapsulePose& capsule;
  float margin;
  const std::uint64_t* near;
  FeatureWords words = FeatureWords(*in.garment);
  float reach = widest_radius(capsule) + in.thickness + margin;  // from the core
  Core lanes = Core(capsule, reach + kLaneRounding);

  PLEAT_KERNEL void run(Stats& stats) const {
    const CapsuleRows rows{maker,   in.packed, in.capsules, in.capsule_count, in.blocks, in.thickness,
                           capsule, lanes,     reach};
    const auto add_round = [&](NearPlaces& places, bool all) {
      places.hand_over(all, [&](std::uint32_t begin, std::uint32_t n) { rows.add_round(places, begin, n, stats); });
    };
    NearPlaces round, flat;
    for_each_eight(near + words.particles, near + words.edges, [&](const std::uint32_t* particle, std::uint32_t used) {
      find_particles(particle, used, round);
      add_round(round, false);
    });
    for_each_eight(near + words.edges, near + words.faces, [&](const std::uint32_t* edge, std::uint32_t used) {
      find_edges(edge, used, round);
      add_round(round, false);
    });
    add_round(round, true);

    const auto add_flat = [&](bool all) {
      flat.hand_over(all, [&](std::uint32_t begin, std::uint32_t n) { rows.add_flat(flat, begin, n, stats); });
    };
    for_each_eight(near + words.faces, near + words.end, [&](const std::uint32_t* face, std::uint32_t used) {
      find_faces(face, used, flat);
      add_flat(false);
    });
    add_flat(true);
  }

 private:
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
         candidates->near.size() >= FeatureWords(*garment).end * capsule_count && contacts.count != nullptr &&
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
    const std::uint64_t* near = candidates->near.data();
    const std::size_t words = FeatureWords(*garment).end;
    for (std::uint32_t c = 0; c < capsule_count; ++c, near += words) {
      const bool none = std::all_of(near, near + words, [](std::uint64_t word) { return word == 0; });
      if (!none) CapsuleTest{*this, maker, capsules[c], margin, near}.run(stats);
    }
  });
}

}  // namespace pleat
