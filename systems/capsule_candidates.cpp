#include "systems/capsule_candidates.h"

#include <algorithm>
#include <memory>

#include "components/wide.h"
#include "systems/box.h"
#include "systems/capsule_lanes.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// Whether a particle and a core may have come nearer to each other than they were by more than `most`, m. Between its
/// ends a core has moved by no more than they have.
PLEAT_KERNEL bool moved_by_more(const CapsuleCandidates& in, float most) {
  const ConstVec3View anchor = in.candidates->anchor.view();
  if (most < 0.0f) return true;
  for (std::uint32_t c = 0; c < in.capsule_count; ++c) {
    const CapsulePose &now = in.capsules[c], &then = in.candidates->sought[c];
    const Vec3Lanes of_a = all(now.a - then.a), of_b = all(now.b - then.b);
    const float motion2 = largest(in.garment->particle_count, [&](std::size_t i) {
      const Vec3Lanes motion = load(in.position, i) - load(anchor, i), a = motion - of_a, b = motion - of_b;
      return max(dot(a, a), dot(b, b));
    });
    if (!(motion2 <= most * most)) return true;
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
    std::uint64_t* at = in.candidates->near.data() + word + begin / kBits;
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
  const ConstVec3View x = in.position;
  mark_near<Vec3Lanes>(in, words.particles, g.particle_count, [&](std::size_t i) { return load(x, i); });
  mark_near<EdgeLanes>(in, words.edges, g.edge_count,
                       [&](std::size_t e) { return EdgeLanes(x, &g.edge_particle[0][e], &g.edge_particle[1][e]); });
  mark_near<FaceLanes>(in, words.faces, g.face_count, [&](std::size_t f) {
    return FaceLanes(x, &g.face_particle[0][f], &g.face_particle[1][f], &g.face_particle[2][f]);
  });
}

}  // namespace

bool CapsuleCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr &&
         (capsules != nullptr || capsule_count == 0) && thickness >= 0.0f && candidates != nullptr &&
         candidates->near.size() >= FeatureWords(*garment).end * capsule_count &&
         candidates->sought.size() >= capsule_count && candidates->anchor.size() >= garment->particle_count;
}

void CapsuleCandidates::run() const {
  run_wide(widest_vectors(), [this] {
    CapsuleCandidateColumns& out = *candidates;
    const std::uint32_t count = garment->particle_count;
    const float margin = contact_margin_in_kernel(position, previous, count);
    const bool stale = first || !same_capsules(*this) || moved_by_more(*this, out.margin - kLaneRounding - margin);
    if (!stale) return;

    for (std::uint32_t i = 0; i < count; i += kLanes) store(load(position, i), out.anchor.view(), i);
    std::copy_n(capsules, capsule_count, out.sought.begin());
    out.sought_count = capsule_count;
    out.margin = margin + kSkin + kLaneRounding;
    mark_all(*this);
  });
}

}  // namespace pleat
