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

/// Some candidates, side by side.
struct Batch {
  std::uint32_t feature[kLanes];
  std::uint32_t count = 0;

  std::uint32_t used() const { return (1u << count) - 1; }  // a bit a place
  /// Column `of` of the features; places without one repeat the first.
  void look_up(const Column<std::uint32_t>& of, std::uint32_t (&found)[kLanes]) const {
    for (std::uint32_t k = 0; k < kLanes; ++k) found[k] = of[feature[k < count ? k : 0]];
  }
};

/// One capsule against one cloth.
struct CapsuleTest {
  const CapsuleDetection& in;
  const CapsulePose& capsule;
  ContactRowMaker rows;
  float margin;
  const std::uint64_t* near;
  FeatureWords words = FeatureWords(*in.garment);
  float reach = widest_radius(capsule) + in.thickness + margin;  // from the core

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
    for (std::uint32_t c = 0; c < in.capsule_count; ++c) {
      const CapsulePose& other = in.capsules[c];
      const bool is_behind = dot(normal, p - other.a) >= 0.0f && dot(normal, p - other.b) >= 0.0f;
      if (is_behind || &other == &capsule) continue;
      const float t = closest_on_capsule(p, other);
      const float needed = radius_at(other, t) + in.thickness + missing;  // from the other's core, for room enough
      if (needed <= 0.0f) continue;
      const Vec3 away = p - lerp(other.a, other.b, t);
      const float facing = -dot(normal, away), d2 = dot(away, away);
      if (facing <= 0.0f || d2 >= needed * needed) continue;
      const float d = std::sqrt(d2);
      given = std::max(given, 0.5f * (needed - d) * std::min(1.0f, 2.0f * facing / d));  // in full within 60 degrees
    }
    return given;
  }

  /// A row that keeps a point of the cloth, now `away` from core(t) and `away_before` from it when the substep began,
  /// on the side where it was.
  void add_round(const std::uint32_t (&particle)[3], const float (&weight)[3], float t, const Vec3& away,
                 const Vec3& away_before, bool at_particle, Stats& stats, float relaxation = 1.0f) const {
    const float side = dot(away, away_before) < 0.0f ? -1.0f : 1.0f;
    const float away2 = dot(away, away);
    const Vec3 normal = away2 > 1e-12f ? away * (side / std::sqrt(away2))
                                       : normalized_or(away_before, any_perpendicular(capsule.b - capsule.a));
    const float kept = distance(t) - given_up(core(t) + away, normal, distance(t) - dot(normal, away));
    rows.add(particle, weight, normal, core(t), kept, core_step(t), capsule.friction, at_particle, stats, relaxation);
  }

  void test_particles(Stats& stats) const {
    for_each_bit(near + words.particles, near + words.edges, [&](std::uint32_t i) {
      if (in.inverse_mass[i] == 0.0f) return;
      const Vec3 p = in.position[i];
      const float t = closest_on_capsule(p, capsule);
      const Vec3 away = p - core(t);
      if (!(dot(away, away) < reach * reach)) return;
      add_round({i, i, i}, {1.0f, 0.0f, 0.0f}, t, away, in.previous[i] - core_before(t), true, stats);
    });
  }

  /// test(batch) for all candidates, in order.
  template <class Test>
  void for_each_batch(const std::uint64_t* begin, const std::uint64_t* end, const Test& test) const {
    Batch batch;
    for_each_bit(begin, end, [&](std::uint32_t feature) {
      batch.feature[batch.count++] = feature;
      if (batch.count < kLanes) return;
      test(batch);
      batch.count = 0;
    });
    if (batch.count != 0) test(batch);
  }

  /// Where the lanes of a batch come closest, and which may be within reach: most candidates no longer are.
  struct EdgeBatch {
    float s[kLanes], t[kLanes];
    std::uint32_t near, crossing;  // a bit a lane
  };

  void test_edges(Stats& stats) const {
    const auto& end = in.garment->edge_particle;
    for_each_batch(near + words.edges, near + words.faces, [&](const Batch& batch) {
      std::uint32_t i[kLanes], j[kLanes];
      batch.look_up(end[0], i), batch.look_up(end[1], j);
      EdgeBatch found;
      run_wide(widest_vectors(), [&] {
        const Core core(capsule, reach + kLaneRounding);
        const EdgeDistance distance(core, EdgeLanes(in.position, i, j));
        store(distance.s, found.s), store(distance.t, found.t);
        found.near = bits(distance.distance2 < core.reach2) & batch.used();
        found.crossing = capsule.taper == 0.0f ? bits(distance.crosses) : 0;
      });
      for (std::uint32_t rest = found.near; rest != 0; rest &= rest - 1) {
        const int k = std::countr_zero(rest);
        const bool known = (found.crossing >> k & 1) != 0;
        const Vec3 xi = in.position[i[k]], xj = in.position[j[k]];
        test_edge(i[k], j[k], known ? SegmentPair{found.s[k], found.t[k]} : closest_to_capsule(xi, xj, capsule), stats);
      }
    });
  }

  void test_edge(std::uint32_t i, std::uint32_t j, const SegmentPair& at, Stats& stats) const {
    const Vec3 xi = in.position[i], xj = in.position[j];
    if (at.s < kEndShare || at.s > 1.0f - kEndShare) return;
    const Vec3 away = lerp(xi, xj, at.s) - core(at.t);
    if (!(dot(away, away) < reach * reach)) return;
    const Vec3 away_before = lerp(in.previous[i], in.previous[j], at.s) - core_before(at.t);
    add_round({i, j, j}, {1.0f - at.s, at.s, 0.0f}, at.t, away, away_before, false, stats, relaxation_at(at.s));
  }

  /// Where an end of the core is over the inside of a face; all other places that are closest belong to its edges.
  void test_faces(Stats& stats) const {
    const auto& corner = in.garment->face_particle;
    for_each_batch(near + words.faces, near + words.end, [&](const Batch& batch) {
      std::uint32_t i[kLanes], j[kLanes], k[kLanes];
      batch.look_up(corner[0], i), batch.look_up(corner[1], j), batch.look_up(corner[2], k);
      std::uint32_t over = 0;
      run_wide(widest_vectors(), [&] {
        over = bits(is_under(Core(capsule, reach + kLaneRounding), FaceLanes(in.position, i, j, k))) & batch.used();
      });
      for (; over != 0; over &= over - 1) {
        const int lane = std::countr_zero(over);
        test_face(i[lane], j[lane], k[lane], stats);
      }
    });
  }

  void test_face(std::uint32_t i, std::uint32_t j, std::uint32_t k, Stats& stats) const {
    const Vec3 xi = in.position[i], u = in.position[j] - xi, v = in.position[k] - xi;
    const Vec3 area = cross(u, v);
    const float area2 = dot(area, area);
    if (!(area2 > 1e-16f)) return;
    for (int end = 0; end < (capsule.a == capsule.b ? 1 : 2); ++end) {
      const float t = static_cast<float>(end);
      const Vec3 w = core(t) - xi;
      const float height = dot(w, area);
      if (height * height > reach * reach * area2) continue;
      const float bj = dot(cross(w, v), area) / area2, bk = dot(cross(u, w), area) / area2;
      if (!(bj > 0.0f && bk > 0.0f && bj + bk < 1.0f)) continue;
      const float bi = 1.0f - bj - bk;
      const Vec3 before = in.previous[i] * bi + in.previous[j] * bj + in.previous[k] * bk - core_before(t);
      const float side = dot(before, area) < 0.0f ? -1.0f : 1.0f;
      const Vec3 normal = area * (side / std::sqrt(area2));
      const float away = -dot(w, normal);
      const float kept = distance(t) - given_up(core(t) + normal * away, normal, distance(t) - away);
      rows.add({i, j, k}, {bi, bj, bk}, normal, core(t), kept, core_step(t), capsule.friction, false, stats);
    }
  }
};

}  // namespace

bool CapsuleDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         (capsules != nullptr || capsule_count == 0) && candidates != nullptr &&
         candidates->near.size() >= FeatureWords(*garment).end * capsule_count && contacts.count != nullptr &&
         thickness >= 0.0f && friction >= 0.0f && dt > 0.0f;
}

void CapsuleDetection::run(Stats& stats) const {
  const float margin = contact_margin(position, previous, garment->particle_count);
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  const std::uint64_t* near = candidates->near.data();
  for (std::uint32_t c = 0; c < capsule_count; ++c, near += FeatureWords(*garment).end) {
    CapsuleTest{*this, capsules[c], rows, margin, near}.run(stats);
  }
}

}  // namespace pleat
