#include "systems/capsule_candidates.h"

#include "components/wide.h"
#include "systems/capsule_shape.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

constexpr float kRelied = 0.999f;  // of the skin; the rest is for rounding

/// The furthest that particles and cores have come away from where they were, beside the particles' mean motion, m.
float relative_motion(const CapsuleCandidates& in) {
  const ConstVec3View anchor = in.candidates->anchor.view();
  const std::uint32_t count = in.garment->particle_count;
  Vec3 sum;
  for (std::uint32_t i = 0; i < count; ++i) sum += in.position[i] - anchor[i];
  const Vec3 mean = sum * (1.0f / static_cast<float>(count));
  float cloth2 = 0.0f, cores2 = 0.0f;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 d = in.position[i] - anchor[i] - mean;
    cloth2 = std::max(cloth2, dot(d, d));
  }
  for (std::uint32_t c = 0; c < in.capsule_count; ++c) {
    const CapsulePose &now = in.capsules[c], &then = in.candidates->sought[c];
    const Vec3 a = now.a - then.a - mean, b = now.b - then.b - mean;
    cores2 = std::max({cores2, dot(a, a), dot(b, b)});
  }
  return std::sqrt(cloth2) + std::sqrt(cores2);
}

bool same_capsules(const CapsuleCandidates& in) {
  const auto same = [](const CapsulePose& p, const CapsulePose& q) { return p.index == q.index; };
  return in.capsule_count == in.candidates->sought_count &&
         std::equal(in.capsules, in.capsules + in.capsule_count, in.candidates->sought.begin(), same);
}

/// Bit i of `bits` is is_near(i), without a branch.
template <class Predicate>
PLEAT_KERNEL void mark(std::uint64_t* bits, std::uint32_t count, const Predicate& is_near) {
  for (std::uint32_t begin = 0; begin < count; begin += 64) {
    const std::uint32_t end = std::min(count - begin, 64u);
    std::uint64_t word = 0;
    for (std::uint32_t k = 0; k < end; ++k) word |= std::uint64_t{is_near(begin + k)} << k;
    *bits++ = word;
  }
}

/// Squared distances of all particles from the core and from the nearer of its ends.
PLEAT_KERNEL void measure_particles(const CapsuleCandidates& in, const CapsulePose& capsule) {
  const Vec3 a = capsule.a, axis = capsule.b - capsule.a;
  const float axis2 = dot(axis, axis), inverse = axis2 > 0.0f ? 1.0f / axis2 : 0.0f;
  float *core = in.scratch->core.data(), *ends = in.scratch->ends.data();
  for (std::uint32_t i = 0; i < in.garment->particle_count; ++i) {
    const Vec3 p = in.position[i] - a;
    const Vec3 d = p - axis * std::min(std::max(dot(p, axis) * inverse, 0.0f), 1.0f), q = p - axis;
    core[i] = dot(d, d);
    ends[i] = std::min(dot(p, p), dot(q, q));
  }
}

PLEAT_KERNEL void measure_edges(const CapsuleCandidates& in) {
  const auto& end = in.garment->edge_particle;
  float* length2 = in.scratch->edge.data();
  for (std::uint32_t e = 0; e < in.garment->edge_count; ++e) {
    const Vec3 d = in.position[end[1][e]] - in.position[end[0][e]];
    length2[e] = dot(d, d);
  }
}

PLEAT_KERNEL void mark_near(const CapsuleCandidates& in, const CapsulePose& capsule, std::uint64_t* near) {
  const Garment& g = *in.garment;
  const FeatureWords words(g);
  const float reach = widest_radius(capsule) + in.thickness + in.candidates->margin, reach2 = reach * reach;
  const float *core = in.scratch->core.data(), *ends = in.scratch->ends.data();
  const float* length2 = in.scratch->edge.data();
  measure_particles(in, capsule);
  mark(near + words.particles, g.particle_count, [&](std::uint32_t i) { return core[i] < reach2; });
  const std::uint32_t *first = g.edge_particle[0].data(), *second = g.edge_particle[1].data();
  mark(near + words.edges, g.edge_count,
       [&](std::uint32_t e) { return !segment_is_beyond(core[first[e]], core[second[e]], length2[e], reach2); });
  const std::uint32_t *i = g.face_particle[0].data(), *j = g.face_particle[1].data(), *k = g.face_particle[2].data();
  const std::uint32_t *u = g.face_edge[0].data(), *v = g.face_edge[1].data(), *w = g.face_edge[2].data();
  mark(near + words.faces, g.face_count, [&](std::uint32_t f) {
    const float nearest2 = std::min(std::min(ends[i[f]], ends[j[f]]), ends[k[f]]);
    const float longest2 = std::max(std::max(length2[u[f]], length2[v[f]]), length2[w[f]]);
    return !triangle_is_beyond(nearest2, longest2, reach2);
  });
}

}  // namespace

bool CapsuleCandidates::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr &&
         (capsules != nullptr || capsule_count == 0) && thickness >= 0.0f && candidates != nullptr &&
         candidates->near.size() >= FeatureWords(*garment).end * capsule_count &&
         candidates->sought.size() >= capsule_count && candidates->anchor.size() >= garment->particle_count &&
         scratch != nullptr && scratch->holds(*garment);
}

void CapsuleCandidates::run() const {
  CapsuleCandidateColumns& out = *candidates;
  const std::uint32_t count = garment->particle_count;
  const float margin = contact_margin(position, previous, count);
  if (!first && same_capsules(*this) && margin + relative_motion(*this) <= out.margin - (1.0f - kRelied) * kSkin)
    return;

  for (std::uint32_t i = 0; i < count; ++i) out.anchor.view().set(i, position[i]);
  std::copy_n(capsules, capsule_count, out.sought.begin());
  out.sought_count = capsule_count;
  out.margin = margin + kSkin;
  run_wide(widest_vectors(), [this] {
    measure_edges(*this);
    std::uint64_t* near = candidates->near.data();
    for (std::uint32_t c = 0; c < capsule_count; ++c, near += FeatureWords(*garment).end) {
      mark_near(*this, capsules[c], near);
    }
  });
}

}  // namespace pleat
