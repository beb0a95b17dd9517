// How a touching place found by detection becomes a row.
#pragma once

#include "components/contacts.h"
#include "components/stats.h"
#include "systems/closest_points.h"

namespace pleat {

/// Rows are made for what is nearer than thickness + kContactMargin, so that the sweeps find the plane of whatever a
/// particle may be moved against. m
inline constexpr float kContactMargin = 0.01f;

/// A deep start is pushed out at this speed, over many substeps, and not in one snap. m/s
inline constexpr float kRecoverySpeed = 2.0f;

/// Keeps d <= (where the point is) + (body's motion + kRecoverySpeed dt): in one substep a row pushes no further.
struct ContactRowMaker {
  ConstVec3View position;
  const float* inverse_mass = nullptr;
  float friction = 0.0f;
  float dt = 0.0f;
  ContactList contacts;

  /// n . (sum of weight x) >= n . surface + distance. Nothing is added where all weight is on pinned particles.
  void add(const std::uint32_t (&particle)[3], const float (&weight)[3], const Vec3& normal, const Vec3& surface,
           float distance, const Vec3& body_step, float body_friction, bool at_particle, Stats& stats) const {
    ContactRow row{.particle = {particle[0], particle[1], particle[2]},
                   .weight = {weight[0], weight[1], weight[2]},
                   .normal = normal,
                   .offset = 0.0f,
                   .body_step = body_step,
                   .friction = friction * body_friction,
                   .inverse_mass = 0.0f,
                   .push = 0.0f,
                   .at_particle = at_particle};
    Vec3 point;
    for (int k = 0; k < 3; ++k) {
      point += position[particle[k]] * weight[k];
      row.inverse_mass += inverse_mass[particle[k]] * weight[k] * weight[k];
    }
    if (!(row.inverse_mass > 0.0f)) return;
    row.offset =
        std::min(dot(normal, surface) + distance, dot(normal, point) + length(body_step) + kRecoverySpeed * dt);
    if (!contacts.add(row)) ++stats.contacts_dropped;
  }
};

}  // namespace pleat
