#include "systems/hinge_bending.h"

#include <algorithm>
#include <numbers>

#include "components/vec3_block.h"
#include "components/wide.h"
#include "systems/angle.h"

namespace pleat {
namespace {

/// theta - theta0 the short way round: a hinge that rests near a full fold must not jump by a turn.
float angle_between(float theta, float rest) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const float d = theta - rest;
  return d > kPi ? d - 2.0f * kPi : d < -kPi ? d + 2.0f * kPi : d;
}

/// Some hinges side by side: where their four particles are, how they move, and what is found of them.
struct HingeBlock {
  Vec3Block position[4], velocity[4], force[4];
  float inverse_mass[4][kLanes], stiffness[kLanes], rest_angle[kLanes];
};

PLEAT_KERNEL void gather(const HingeBending& in, std::uint32_t begin, std::uint32_t count, HingeBlock& block) {
  const Garment& g = *in.garment;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const std::uint32_t h = begin + std::min(lane, count - 1);
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t p = g.hinge_particle[k][h];
      block.position[k].set(lane, in.position[p]);
      block.velocity[k].set(lane, in.velocity[p]);
      block.inverse_mass[k][lane] = in.inverse_mass[p];
    }
    block.stiffness[lane] = in.stiffness * g.hinge_shape[h];
    block.rest_angle[lane] = g.hinge_rest_angle[h];
  }
}

PLEAT_KERNEL void bend(HingeBlock& block, float safe_rate, float bound) {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const Vec3 x0 = block.position[0][lane], x1 = block.position[1][lane];
    const Vec3 x2 = block.position[2][lane], x3 = block.position[3][lane];
    const Vec3 e = x1 - x0;
    const Vec3 na = cross(e, x2 - x0), nb = cross(x3 - x0, e);
    const float na2 = dot(na, na), nb2 = dot(nb, nb), e_length = length(e);
    const float least = std::min(std::min(na2, nb2) * (1.0f / 4e-24f), e_length * (1.0f / 1e-9f));  // >= 1: has extent

    const Vec3 u = e * (1.0f / (least < 1.0f ? 1.0f : e_length));
    const Vec3 a = na * (1.0f / (least < 1.0f ? 1.0f : na2)), b = nb * (1.0f / (least < 1.0f ? 1.0f : nb2));
    const Vec3 g0 = -(a * dot(x2 - x1, u) + b * dot(x3 - x1, u)), g1 = a * dot(x2 - x0, u) + b * dot(x3 - x0, u);
    const Vec3 g2 = a * -e_length, g3 = b * -e_length;
    const float w0 = block.inverse_mass[0][lane], w1 = block.inverse_mass[1][lane];
    const float w2 = block.inverse_mass[2][lane], w3 = block.inverse_mass[3][lane];
    const float yielding = w0 * dot(g0, g0) + w1 * dot(g1, g1) + w2 * dot(g2, g2) + w3 * dot(g3, g3);
    const float speed = dot(g0, block.velocity[0][lane]) + dot(g1, block.velocity[1][lane]) +
                        dot(g2, block.velocity[2][lane]) + dot(g3, block.velocity[3][lane]);
    const float yields = yielding > 0.0f ? yielding : 1.0f;

    const float theta = angle_of(-e_length * dot(na, x3 - x0), dot(na, nb));
    const float highest = bound / yields, stiffness = block.stiffness[lane];
    const float c = stiffness < highest ? stiffness : highest;
    const float bending = c * angle_between(theta, block.rest_angle[lane]) + safe_rate / yields * speed;
    const float moment = least < 1.0f ? 0.0f : yielding > 0.0f ? -bending : 0.0f;
    block.force[0].set(lane, g0 * moment);
    block.force[1].set(lane, g1 * moment);
    block.force[2].set(lane, g2 * moment);
    block.force[3].set(lane, g3 * moment);
  }
}

PLEAT_KERNEL void scatter(const HingeBending& in, std::uint32_t begin, std::uint32_t count, const HingeBlock& block) {
  for (std::uint32_t lane = 0; lane < count; ++lane) {
    for (int k = 0; k < 4; ++k) in.force.add(in.garment->hinge_particle[k][begin + lane], block.force[k][lane]);
  }
}

PLEAT_KERNEL void bend_all(const HingeBending& in) {
  const float safe_rate = std::min(in.damping_rate, 0.2f / in.dt), bound = 0.2f / (in.dt * in.dt);
  for (std::uint32_t begin = 0; begin < in.garment->hinge_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, in.garment->hinge_count - begin);
    HingeBlock block;
    gather(in, begin, count, block);
    bend(block, safe_rate, bound);
    scatter(in, begin, count, block);
  }
}

}  // namespace

bool HingeBending::validate() const {
  return garment != nullptr && position.x != nullptr && velocity.x != nullptr && inverse_mass != nullptr &&
         force.x != nullptr && stiffness >= 0.0f && damping_rate >= 0.0f && dt > 0.0f;
}

void HingeBending::run(VectorSet set) const {
  run_wide(set, [this] { bend_all(*this); });
}

}  // namespace pleat
