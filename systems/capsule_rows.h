// How places where a cloth is near a capsule become contact rows, eight at once.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>

#include "systems/capsule_lanes.h"
#include "systems/contact_row.h"

namespace pleat {

/// An edge's ends are tested as particles; this much of it at each end is theirs. From there to kFullShare the edge's
/// row gains strength: where bodies leave no room a row that comes and goes whole would keep the cloth trembling.
inline constexpr float kEndShare = 0.02f, kFullShare = 0.17f;
inline constexpr float kLeastRelaxation = 0.01f;

/// Places found near one capsule, until there are eight to make rows of.
struct NearPlaces {
  static constexpr std::uint32_t kRoom = 3 * kLanes;  // seven that were left and what eight faces may add
  Vec4Place particle[3][kRoom];
  float s[kRoom], t[kRoom];  // along an edge, along the core, 0 to 1
  std::uint32_t count = 0;

  PLEAT_KERNEL void add(Vec4Place i, Vec4Place j, Vec4Place k, float along, float along_core) {
    particle[0][count] = i, particle[1][count] = j, particle[2][count] = k, s[count] = along, t[count] = along_core;
    ++count;
  }

  /// How many of the first lanes there are; the others are filled up with the first one.
  PLEAT_KERNEL std::uint32_t first_lanes() {
    for (std::uint32_t k = count; k < kLanes; ++k) copy(0, k);
    return std::min(count, kLanes);
  }
  PLEAT_KERNEL void drop_lanes() {
    const std::uint32_t left = count - std::min(count, kLanes);
    for (std::uint32_t k = 0; k < left; ++k) copy(kLanes + k, k);
    count = left;
  }

 private:
  PLEAT_KERNEL void copy(std::uint32_t from, std::uint32_t to) {
    for (auto& corner : particle) corner[to] = corner[from];
    s[to] = s[from], t[to] = t[from];
  }
};

/// Makes the rows of one capsule, among others, against one cloth.
struct CapsuleRows {
  const Vec4* position;  // of the cloth, m, and w, inverse mass, 1/kg
  const Vec4* previous;  // m, when the substep began
  const CapsulePose* capsules;
  std::uint32_t capsule_count;
  const CapsuleBlock* blocks;  // the same capsules
  float thickness, friction;   // of the cloth, m
  float dt;                    // s
  ContactList contacts;
  const CapsulePose& capsule;
  const Core& core;
  float reach;  // from the core, m

  /// Rows that keep points of particles and edges on the side of the core where they were when the substep began. A
  /// particle is an edge from itself to itself, s = 0.
  PLEAT_KERNEL void add_round(const NearPlaces& places, std::uint32_t count, Stats& stats) const {
    Corners<2> at(*this, places);
    const Lanes s = load(places.s), t = load(places.t);
    at.weight[0] = 1.0f - s, at.weight[1] = s;
    const Vec3Lanes on_core = core_at(t), step = step_at(t);
    const Vec3Lanes away = along(at.now[0], at.now[1], s) - on_core;
    const Vec3Lanes away_before = along(at.before[0], at.before[1], s) - (on_core - step);
    const Lanes away2 = dot(away, away);
    const LaneMask valid = first_lanes(count) & (away2 < reach * reach), clear = away2 > 1e-12f;

    const Lanes side = dot(away, away_before) < 0.0f ? all(-1.0f) : all(1.0f);
    Vec3Lanes normal = away * (side / sqrt(away2));
    if (any(valid & ~clear)) {
      normal = choose(clear, normal, normalized_or(away_before, all(any_perpendicular(capsule.b - capsule.a))));
    }
    const Lanes from_end = min(s, 1.0f - s);
    const Lanes gained = max((from_end - kEndShare) / (kFullShare - kEndShare), all(kLeastRelaxation));
    const Lanes relaxation = s == 0.0f ? all(1.0f) : min(gained, all(1.0f));
    const Lanes distance = distance_at(t);
    add(at, normal, on_core, on_core + away, distance, distance - dot(normal, away), step, relaxation, valid, stats);
  }

  /// Rows that keep faces on their side of an end of the core.
  PLEAT_KERNEL void add_flat(const NearPlaces& places, std::uint32_t count, Stats& stats) const {
    Corners<3> at(*this, places);
    const Lanes t = load(places.t);
    const Vec3Lanes on_core = core_at(t), step = step_at(t);
    const FaceAreas faces(at.now[0], at.now[1], at.now[2]);
    const FootWeights foot(faces, on_core);
    const Lanes first = 1.0f - foot.second - foot.third;
    at.weight[0] = first, at.weight[1] = foot.second, at.weight[2] = foot.third;
    const Vec3Lanes before =
        at.before[0] * first + at.before[1] * foot.second + at.before[2] * foot.third - (on_core - step);
    const Lanes side = dot(before, faces.area) < 0.0f ? all(-1.0f) : all(1.0f);
    const Vec3Lanes normal = faces.area * (side / sqrt(faces.area2));
    const Lanes away = dot(at.now[0] - on_core, normal), distance = distance_at(t);
    add(at, normal, on_core, on_core + normal * away, distance, distance - away, step, all(1.0f), first_lanes(count),
        stats);
  }

 private:
  /// Where up to three particles of each place are and were, their inverse masses and weights.
  template <std::uint32_t kCount>
  struct Corners {
    std::uint32_t particle[kCount][kLanes];
    Vec3Lanes now[kCount], before[kCount];
    Lanes inverse_mass[kCount], weight[kCount];

    PLEAT_KERNEL Corners(const CapsuleRows& rows, const NearPlaces& places) {
      for (std::uint32_t k = 0; k < kCount; ++k) {
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) particle[k][lane] = places.particle[k][lane].index();
        const Vec4Lanes found = gather(rows.position, places.particle[k]);
        now[k] = found.vector, inverse_mass[k] = found.w;
        before[k] = gather(rows.previous, places.particle[k]).vector;
      }
    }
  };

  static PLEAT_KERNEL Vec3Lanes along(const Vec3Lanes& a, const Vec3Lanes& b, const Lanes& t) {
    return a + (b - a) * t;
  }
  PLEAT_KERNEL Vec3Lanes core_at(const Lanes& t) const { return along(all(capsule.a), all(capsule.b), t); }
  PLEAT_KERNEL Vec3Lanes step_at(const Lanes& t) const { return along(all(capsule.step_a), all(capsule.step_b), t); }
  PLEAT_KERNEL Lanes distance_at(const Lanes& t) const {  // that is kept from the core
    return all(capsule.radius) + t * capsule.taper + thickness;
  }
  static PLEAT_KERNEL Vec3 any_perpendicular(const Vec3& a) {
    return normalized_or(std::abs(a.x) < std::abs(a.y) ? Vec3{0.0f, a.z, -a.y} : Vec3{-a.z, 0.0f, a.x}, {0, 1, 0});
  }

  /// What of the distance to keep from the core is given up at places of the cloth that are `missing` closer than they
  /// should be.
  /// Where another capsule presses the cloth against this one and the gap is too narrow for it, each gives way by half
  /// of what is missing, so that their rows meet half way and do not throw the cloth to and fro. That is for surfaces
  /// that face each other; where they part at a right angle or wider the cloth can leave and neither gives way.
  PLEAT_KERNEL Lanes given_up(const Vec3Lanes& places, const Vec3Lanes& core_there, const Vec3Lanes& normals,
                              const Lanes& missing, const LaneMask& valid) const {
    Lanes given{};
    const float room = thickness + largest(valid ? length(places - core_there) + missing : all(-1e3f));
    for (std::uint32_t first = 0; first < capsule_count; first += kLanes) {
      const CapsuleBlock& block = blocks[first / kLanes];
      std::uint32_t pressing = bits(may_press(block, core, room));
      for (; pressing != 0; pressing &= pressing - 1) {
        const int c = std::countr_zero(pressing);
        const CapsulePose& other = capsules[first + static_cast<std::uint32_t>(c)];
        if (&other == &capsule) continue;
        std::uint32_t pressed = bits(may_be_pressed(block, c, places, normals, missing) & valid);
        for (; pressed != 0; pressed &= pressed - 1) {
          const int k = std::countr_zero(pressed);
          const Vec3 p{places.x[k], places.y[k], places.z[k]}, normal{normals.x[k], normals.y[k], normals.z[k]};
          given[k] = std::max(given[k], given_up_to(other, p, normal, missing[k]));
        }
      }
    }
    return given;
  }
  /// Which places may be nearer to capsule c of a block than they should, and not have it behind them where they are to
  /// be moved along their normals. One that tapers counts as if it were as thick all along.
  PLEAT_KERNEL LaneMask may_be_pressed(const CapsuleBlock& block, int c, const Vec3Lanes& places,
                                       const Vec3Lanes& normals, const Lanes& missing) const {
    const Vec3Lanes axis{all(block.axis.x[c]), all(block.axis.y[c]), all(block.axis.z[c])};
    const Vec3Lanes from_a = places - Vec3Lanes{all(block.a.x[c]), all(block.a.y[c]), all(block.a.z[c])};
    const Vec3Lanes away = from_a - axis * clamped(dot(from_a, axis) * block.inverse[c]);
    const Lanes needed = missing + (block.widest[c] + thickness + kLaneRounding);
    const LaneMask near = (needed > 0.0f) & (dot(away, away) < needed * needed);
    if (!any(near)) return near;
    const Lanes a_behind = dot(normals, from_a), b_behind = a_behind - dot(normals, axis);
    return near & (min(a_behind, b_behind) < kLaneRounding);
  }
  PLEAT_KERNEL float given_up_to(const CapsulePose& other, const Vec3& p, const Vec3& normal, float missing) const {
    const float t = closest_on_capsule(p, other);
    const float needed = radius_at(other, t) + thickness + missing;  // from the other's core, for room enough
    if (needed <= 0.0f) return 0.0f;
    const Vec3 away = p - lerp(other.a, other.b, t);
    const float facing = -dot(normal, away), d2 = dot(away, away);
    if (facing <= 0.0f || d2 >= needed * needed) return 0.0f;
    const float d = std::sqrt(d2);
    return 0.5f * (needed - d) * std::min(1.0f, 2.0f * facing / d);  // in full within 60 degrees
  }

  /// As ContactRowMaker, eight at once: rows that keep `places` of the cloth at `distance` from `core_there`.
  template <std::uint32_t kCount>
  PLEAT_KERNEL void add(const Corners<kCount>& at, const Vec3Lanes& normal, const Vec3Lanes& core_there,
                        const Vec3Lanes& places, const Lanes& distance, const Lanes& missing, const Vec3Lanes& step,
                        const Lanes& relaxation, LaneMask valid, Stats& stats) const {
    Vec3Lanes carried = step;
    Lanes yielding{}, lightest{};  // 1/kg
    for (std::uint32_t k = 0; k < kCount; ++k) {
      const Lanes &w = at.inverse_mass[k], &b = at.weight[k];
      carried += at.before[k] * b;
      yielding += w * b * b;
      lightest = b != 0.0f ? max(w, lightest) : lightest;
    }
    valid &= yielding > 0.0f;
    std::uint32_t rest = bits(valid);
    const Lanes kept = distance - given_up(places, core_there, normal, missing, valid);
    const Lanes most = dot(normal, carried) + kRecoverySpeed * dt;
    yielding = max(yielding, lightest * kLeastYield) / relaxation;
    Lanes share[3]{};
    for (std::uint32_t k = 0; k < kCount; ++k) share[k] = at.inverse_mass[k] * at.weight[k] / yielding;

    Four plane[kLanes], motion[kLanes], weights[kLanes], shares[kLanes];
    split(normal, min(most, dot(normal, core_there) + kept), plane);
    split(step, all(friction * capsule.friction), motion);
    if constexpr (kCount == 2) {
      split({at.weight[0], at.weight[1], Lanes{}}, Lanes{}, weights);
    } else {
      split({at.weight[0], at.weight[1], at.weight[2]}, Lanes{}, weights);
    }
    split({share[0], share[1], share[2]}, Lanes{}, shares);
    for (; rest != 0; rest &= rest - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
      if (*contacts.count == contacts.capacity) {
        ++stats.contacts_dropped;
        continue;
      }
      ContactRow& row = contacts.rows[(*contacts.count)++];
      for (std::uint32_t p = 0; p < 4; ++p) row.particle[p] = p < 3 ? at.particle[std::min(p, kCount - 1)][k] : 0;
      put(weights[k], offsetof(ContactRow, weight), row);
      put(plane[k], offsetof(ContactRow, normal), row);
      put(motion[k], offsetof(ContactRow, body_step), row);
      put(shares[k], offsetof(ContactRow, share), row);
      row.count = kCount == 2 && row.particle[0] == row.particle[1] ? 1 : kCount;
      row.push = row.rubbed = 0.0f;
    }
  }

  /// Four floats of a row, the first `at` bytes from where it begins.
  static PLEAT_KERNEL void put(const Four& values, std::size_t at, ContactRow& row) {
    std::memcpy(reinterpret_cast<char*>(&row) + at, &values, sizeof values);
  }
};

static_assert(offsetof(ContactRow, offset) == offsetof(ContactRow, normal) + sizeof(Vec3) &&
              offsetof(ContactRow, friction) == offsetof(ContactRow, body_step) + sizeof(Vec3));

}  // namespace pleat
