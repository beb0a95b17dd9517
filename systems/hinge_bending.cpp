#include "systems/hinge_bending.h"

#include <algorithm>
#include <numbers>

#include "systems/angle.h"

namespace pleat {
namespace {

/// theta - theta0 the short way round: a hinge that rests near a full fold must not jump by a turn.
float angle_between(float theta, float rest) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const float d = theta - rest;
  return d > kPi ? d - 2.0f * kPi : d < -kPi ? d + 2.0f * kPi : d;
}

}  // namespace

bool HingeBending::validate() const {
  return garment != nullptr && position.x != nullptr && velocity.x != nullptr && inverse_mass != nullptr &&
         force.x != nullptr && stiffness >= 0.0f && damping_rate >= 0.0f && dt > 0.0f;
}

void HingeBending::run() const {
  const float safe_rate = std::min(damping_rate, 0.2f / dt);
  const float bound = 0.35f / (dt * dt);
  for (std::uint32_t h = 0; h < garment->hinge_count; ++h) {
    const std::uint32_t p[4] = {garment->hinge_particle[0][h], garment->hinge_particle[1][h],
                                garment->hinge_particle[2][h], garment->hinge_particle[3][h]};
    const Vec3 x0 = position[p[0]], x1 = position[p[1]], x2 = position[p[2]], x3 = position[p[3]];
    const Vec3 e = x1 - x0;
    const Vec3 na = cross(e, x2 - x0), nb = cross(x3 - x0, e);
    const float na2 = dot(na, na), nb2 = dot(nb, nb), e_length = length(e);
    if (na2 < 4e-24f || nb2 < 4e-24f || e_length < 1e-9f) continue;

    const Vec3 u = e * (1.0f / e_length);
    const Vec3 a = na * (1.0f / na2), b = nb * (1.0f / nb2);
    const Vec3 g[4] = {-(a * dot(x2 - x1, u) + b * dot(x3 - x1, u)), a * dot(x2 - x0, u) + b * dot(x3 - x0, u),
                       a * -e_length, b * -e_length};
    float yielding = 0.0f, speed = 0.0f;
    for (int k = 0; k < 4; ++k) {
      yielding += inverse_mass[p[k]] * dot(g[k], g[k]);
      speed += dot(g[k], velocity[p[k]]);
    }
    if (yielding == 0.0f) continue;

    const float theta = angle_of(-e_length * dot(na, x3 - x0), dot(na, nb));
    const float c = std::min(stiffness * garment->hinge_shape[h], bound / yielding);
    const float moment = c * angle_between(theta, garment->hinge_rest_angle[h]) + safe_rate / yielding * speed;
    for (int k = 0; k < 4; ++k) force.add(p[k], g[k] * -moment);
  }
}

}  // namespace pleat
