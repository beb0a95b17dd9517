#include "systems/capsule_detection.h"

#include <algorithm>
#include <bit>

#include "systems/capsule_lanes.h"
#include "systems/contact_row.h"

namespace pleat {
namespace {

/// An edge's ends are tested as particles; this much of it at each end is theirs. From there to kFullShare the edge's
/// row gains strength: where bodies leave no room a row that comes and goes whole would keep the cloth trembling.
constexpr float kEndShare = 0.02f, kFullShare = 0.17f;
constexpr float kLeastRelaxation = 0.01f;

/// How much of its push an edge's row makes in each sweep; s: the touching point's place along the edge, 0 to 1.
float relaxation_at(float s) {
  const float from_end = std::min(s, 1.0f - s);
  return std::clamp((from_end - kEndShare) / (kFullShare - kEndShare), kLeastRelaxation, 1.0f);
}

Vec3 any_perpendicular(const Vec3& a) {
  return normalized_or(std::abs(a.x) < std::abs(a.y) ? Vec3{0.0f, a.z, -a.y} : Vec3{-a.z, 0.0f, a.x}, {0, 1, 0});
}

/// One capsule against one cloth.
struct CapsuleTest {
  const CapsuleDetection& in;
  const CapsulePose& capsule;
  ContactRowMaker rows;
  float margin;
  const std::uint64_t* near;
  FeatureWords words = FeatureWords(*in.garment);
  float reach = widest_radius(capsule) + in.thickness + margin;  // from the core
  Core lanes = Core(capsule, reach + kLaneRounding);

  void run(Stats& stats) const {
    test_particles(stats);
    test_edges(stats);
    test_faces(stats);
  }

 private:
  Vec3 core(float t) const { return lerp(capsule.a, capsule.b, t); }
  Vec3 core_step(float t) const { return lerp(capsule.step_a, capsule.step_b, t); }
  Vec3 core_before(float t) const { return core(t) - core_step(t); }
  float distance(float t) const { return radius_at(capsule, t) + in.thickness; }  // that is kept from the core

  /// What of the distance to keep from the core is given up at a point p of the cloth that is `missing` closer than it
  /// should be.
  /// Where another capsule presses the cloth against this one and the gap is too narrow for it, each gives way by half
  /// of what is missing, so that their rows meet half way and do not throw the cloth to and fro. That is for surfaces
  /// that face each other; where they part at a right angle or wider the cloth can leave and neither gives way.
  float given_up(const Vec3& p, const Vec3& normal, float missing) const {
    float given = 0.0f;
    for (std::uint32_t first = 0; first < in.capsule_count; first += kLanes) {
      const CapsuleBlock& block = in.blocks[first / kLanes];
      std::uint32_t pressing = bits(may_press(block, p, normal, in.thickness + missing));
      for (; pressing != 0; pressing &= pressing - 1) {
        const CapsulePose& other = in.capsules[first + static_cast<std::uint32_t>(std::countr_zero(pressing))];
        if (&other != &capsule) given = std::max(given, given_up_to(other, p, normal, missing));
      }
    }
    return given;
  }
  float given_up_to(const CapsulePose& other, const Vec3& p, const Vec3& normal, float missing) const {
    const float t = closest_on_capsule(p, other);
    const float needed = radius_at(other, t) + in.thickness + missing;  // from the other's core, for room enough
    if (needed <= 0.0f) return 0.0f;
    const Vec3 away = p - lerp(other.a, other.b, t);
    const float facing = -dot(normal, away), d2 = dot(away, away);
    if (facing <= 0.0f || d2 >= needed * needed) return 0.0f;
    const float d = std::sqrt(d2);
    return 0.5f * (needed - d) * std::min(1.0f, 2.0f * facing / d);  // in full within 60 degrees
  }

  /// A row that keeps a point of the cloth, now `away` from core(t) and `away_before` from it when the substep began,
  /// on the side where it was.
  void add_round(const std::uint32_t (&particle)[3], const float (&weight)[3], float t, const Vec3& away,
                 const Vec3& away_before, std::uint32_t count, Stats& stats, float relaxation = 1.0f) const {
    const float side = dot(away, away_before) < 0.0f ? -1.0f : 1.0f;
    const float away2 = dot(away, away);
    const Vec3 normal = away2 > 1e-12f ? away * (side / std::sqrt(away2))
                                       : normalized_or(away_before, any_perpendicular(capsule.b - capsule.a));
    const float kept = distance(t) - given_up(core(t) + away, normal, distance(t) - dot(normal, away));
    rows.add(particle, weight, normal, core(t), kept, core_step(t), capsule.friction, count, stats, relaxation);
  }

  void test_particles(Stats& stats) const {
    for_each_bit(near + words.particles, near + words.edges, [&](std::uint32_t i) {
      if (in.inverse_mass[i] == 0.0f) return;
      const Vec3 p = in.position[i];
      const float t = closest_on_capsule(p, capsule);
      const Vec3 away = p - core(t);
      if (!(dot(away, away) < reach * reach)) return;
      add_round({i, i, i}, {1.0f, 0.0f, 0.0f}, t, away, in.previous[i] - core_before(t), 1, stats);
    });
  }

  /// test(features, used) for all candidates in order, eight at a time. The last may be fewer: `used` has a bit for
  /// each place with a candidate of its own.
  template <class Test>
  void for_each_eight(const std::uint64_t* begin, const std::uint64_t* end, const Test& test) const {
    constexpr std::uint32_t kBits = 64;
    std::uint32_t feature[kLanes + kBits + kLanes], count = 0;
    for (const std::uint64_t* word = begin; word != end; ++word) {
      const auto first = kBits * static_cast<std::uint32_t>(word - begin);
      for (std::uint64_t rest = *word; rest != 0; rest &= rest - 1) {
        feature[count++] = first + static_cast<std::uint32_t>(std::countr_zero(rest));
      }
      std::uint32_t ready = count / kLanes * kLanes;
      if (word + 1 == end && ready != count) std::fill_n(feature + count, kLanes, feature[0]), ready = count;
      for (std::uint32_t k = 0; k < ready; k += kLanes) {
        test(feature + k, (1u << std::min(ready - k, kLanes)) - 1);
      }
      std::copy(feature + ready, feature + count, feature);
      count -= ready;
    }
  }

  /// Where eight features have a corner that is in column `corner`.
  Vec3Lanes places(const Column<std::uint32_t>& corner, const std::uint32_t* feature) const {
    std::uint32_t index[kLanes];
    for (std::uint32_t k = 0; k < kLanes; ++k) index[k] = corner[feature[k]];
    return gather(in.position, index);
  }

  void test_edges(Stats& stats) const {
    const auto& end = in.garment->edge_particle;
    for_each_eight(near + words.edges, near + words.faces, [&](const std::uint32_t* edge, std::uint32_t used) {
      const EdgeDistance found(lanes, EdgeLanes(places(end[0], edge), places(end[1], edge)));
      const LaneMask known = capsule.taper == 0.0f ? found.crosses : LaneMask{};
      const LaneMask at_end = (found.s < kEndShare) | (found.s > 1.0f - kEndShare);
      std::uint32_t rest = bits((found.distance2 < lanes.reach2) & ~(known & at_end)) & used;
      if (rest == 0) return;
      float s[kLanes], t[kLanes];
      store(found.s, s), store(found.t, t);
      const std::uint32_t good = bits(known);
      for (; rest != 0; rest &= rest - 1) {
        const int k = std::countr_zero(rest);
        const std::uint32_t i = end[0][edge[k]], j = end[1][edge[k]];
        const bool is_good = (good >> k & 1) != 0;
        test_edge(i, j, is_good ? SegmentPair{s[k], t[k]} : closest_to_capsule(in.position[i], in.position[j], capsule),
                  stats);
      }
    });
  }

  void test_edge(std::uint32_t i, std::uint32_t j, const SegmentPair& at, Stats& stats) const {
    if (at.s < kEndShare || at.s > 1.0f - kEndShare) return;
    const Vec3 away = lerp(in.position[i], in.position[j], at.s) - core(at.t);
    if (!(dot(away, away) < reach * reach)) return;
    const Vec3 away_before = lerp(in.previous[i], in.previous[j], at.s) - core_before(at.t);
    add_round({i, j, j}, {1.0f - at.s, at.s, 0.0f}, at.t, away, away_before, 2, stats, relaxation_at(at.s));
  }

  /// Where an end of the core is over the inside of a face; all other places that are closest belong to its edges.
  void test_faces(Stats& stats) const {
    const auto& corner = in.garment->face_particle;
    for_each_eight(near + words.faces, near + words.end, [&](const std::uint32_t* face, std::uint32_t used) {
      const FaceAreas faces(places(corner[0], face), places(corner[1], face), places(corner[2], face));
      const PointOver a(faces, all(core(0.0f)), reach), b(faces, all(core(1.0f)), reach);
      const std::uint32_t over_a = bits(a.over) & used, over_b = capsule.a == capsule.b ? 0 : bits(b.over) & used;
      for (std::uint32_t rest = over_a | over_b; rest != 0; rest &= rest - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
        const std::uint32_t at[] = {corner[0][face[k]], corner[1][face[k]], corner[2][face[k]]};
        if ((over_a >> k & 1) != 0) add_flat(at, a.second[k], a.third[k], 0.0f, stats);
        if ((over_b >> k & 1) != 0) add_flat(at, b.second[k], b.third[k], 1.0f, stats);
      }
    });
  }

  /// A row that keeps a face, at these weights of its second and third corners, on its side of core(t).
  void add_flat(const std::uint32_t (&face)[3], float second, float third, float t, Stats& stats) const {
    const auto& [i, j, k] = face;
    const float first = 1.0f - second - third;
    const Vec3 xi = in.position[i], area = cross(in.position[j] - xi, in.position[k] - xi);
    const Vec3 before = in.previous[i] * first + in.previous[j] * second + in.previous[k] * third - core_before(t);
    const float side = dot(before, area) < 0.0f ? -1.0f : 1.0f;
    const Vec3 normal = area * (side / std::sqrt(dot(area, area)));
    const float away = dot(xi - core(t), normal);
    const float kept = distance(t) - given_up(core(t) + normal * away, normal, distance(t) - away);
    rows.add(face, {first, second, third}, normal, core(t), kept, core_step(t), capsule.friction, 3, stats);
  }
};

}  // namespace

bool CapsuleDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         (capsule_count == 0 || (capsules != nullptr && blocks != nullptr)) && candidates != nullptr &&
         candidates->near.size() >= FeatureWords(*garment).end * capsule_count && contacts.count != nullptr &&
         thickness >= 0.0f && friction >= 0.0f && dt > 0.0f;
}

void CapsuleDetection::run(Stats& stats) const {
  run_wide(widest_vectors(), [&] {
    for (std::uint32_t c = 0; c < capsule_count; ++c) {
      if (c % kLanes == 0) blocks[c / kLanes] = CapsuleBlock{};
      blocks[c / kLanes].put(c % kLanes, capsules[c]);
    }
    const float margin = contact_margin_in_kernel(position, previous, garment->particle_count);
    const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
    const std::uint64_t* near = candidates->near.data();
    const std::size_t words = FeatureWords(*garment).end;
    for (std::uint32_t c = 0; c < capsule_count; ++c, near += words) {
      const bool none = std::all_of(near, near + words, [](std::uint64_t word) { return word == 0; });
      if (!none) CapsuleTest{*this, capsules[c], rows, margin, near}.run(stats);
    }
  });
}

}  // namespace pleat
