// How a touching place found by detection becomes a row.
#pragma once

#include "components/contacts.h"
#include "components/lanes.h"
#include "components/stats.h"
#include "components/wide.h"
#include "systems/closest_points.h"

namespace pleat {

/// How far the particle has moved in the substep that has moved most, m.
inline float longest_motion(ConstVec3View position, ConstVec3View previous, std::uint32_t count) {
  float motion2 = 0.0f;
  run_wide(widest_vectors(), [&] {
    motion2 = largest(count, [&](std::size_t i) {
      const Vec3Lanes d = load(position, i) - load(previous, i);
      return dot(d, d);
    });
  });
  return std::sqrt(motion2);
}

inline constexpr float kLeastMargin = 0.01f, kLeastCapsuleMargin = 0.006f;  // m

/// Rows are made for what is nearer than thickness + margin, so that the sweeps find the plane of whatever a particle
/// may be moved against: kLeastMargin, or more for a cloth that moves further in the substep. m
inline float contact_margin(ConstVec3View position, ConstVec3View previous, std::uint32_t count) {
  return std::max(kLeastMargin, longest_motion(position, previous, count));
}
/// The same of capsules, which are smooth: rows of what is farther from them never pushed (bench/README.md).
inline float capsule_margin(ConstVec3View position, ConstVec3View previous, std::uint32_t count) {
  return std::max(kLeastCapsuleMargin, 0.5f * longest_motion(position, previous, count));
}

/// A deep start is pushed out at this speed, over many substeps, and not in one snap. m/s
inline constexpr float kRecoverySpeed = 2.0f;

/// A point near a pinned particle hardly yields, and the free particles across from it would have to fly far to move
/// it. They are let off: a row yields at least as if it were held with this share of its lightest particle. Rows
/// without pins yield by more than that.
inline constexpr float kLeastYield = 0.1f;

/// A row undoes whatever brought the point nearer to the body in this substep, and of what was missing before it
/// kRecoverySpeed dt: offset <= n . (where the point would be, had it moved with the body) + kRecoverySpeed dt.
struct ContactRowMaker {
  ConstVec3View previous;  // when the substep began
  const float* inverse_mass = nullptr;
  float friction = 0.0f;
  float dt = 0.0f;
  ContactList contacts;

  /// n . (sum of weight x) >= n . surface + distance, over `count` particles: one, an edge's two or a face's three.
  /// Nothing is added where all weight is on pinned particles.
  /// `relaxation`: of what is missing, the share that is made up in each sweep.
  void add(const std::uint32_t (&particle)[3], const float (&weight)[3], const Vec3& normal, const Vec3& surface,
           float distance, const Vec3& body_step, float body_friction, std::uint32_t count, Stats& stats,
           float relaxation = 1.0f) const {
    add({.particle = {particle[0], particle[1], particle[2]},
         .weight = {weight[0], weight[1], weight[2]},
         .normal = normal,
         .offset = dot(normal, surface) + distance,
         .body_step = body_step,
         .friction = friction * body_friction,
         .share = {},
         .count = count,
         .push = 0.0f,
         .rubbed = 0.0f},
        stats, relaxation);
  }

  /// Fills in the shares, and brings offset down to what the substep may undo.
  void add(ContactRow row, Stats& stats, float relaxation = 1.0f) const {
    Vec3 carried = row.body_step;
    float lightest = 0.0f, yielding = 0.0f;  // 1/kg
    for (std::uint32_t k = 0; k < row.count; ++k) {
      const float w = inverse_mass[row.particle[k]], b = row.weight[k];
      carried += previous[row.particle[k]] * b;
      yielding += w * b * b;
      if (b != 0.0f) lightest = std::max(lightest, w);
    }
    if (!(yielding > 0.0f)) return;
    yielding = std::max(yielding, kLeastYield * lightest) / relaxation;
    for (std::uint32_t k = 0; k < row.count; ++k) {
      row.share[k] = inverse_mass[row.particle[k]] * row.weight[k] / yielding;
    }
    row.offset = std::min(row.offset, dot(row.normal, carried) + kRecoverySpeed * dt);
    if (!contacts.add(row)) ++stats.contacts_dropped;
  }
};

/// Whether the cloth was inside the row's body when the substep began, by kDeep or by all that a substep makes up.
inline bool comes_from_inside(const ContactRow& row, ConstVec3View previous, float dt) {
  constexpr float kDeep = 5e-4f, kRounding = 1e-6f;  // m
  const Vec3 carried = contact_point(row, previous) + row.body_step;
  return row.offset > dot(row.normal, carried) + std::min(kDeep, kRecoverySpeed * dt) - kRounding;
}

}  // namespace pleat
