#include "systems/hinge_bending.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// Some hinges side by side: where their four particles are, how they move.
struct Gathered {
  Vec3Block position[4], velocity[4];
  float inverse_mass[4][kLanes], stiffness[kLanes], rest_angle[kLanes];
};

PLEAT_KERNEL void gather(const HingeBending& in, std::uint32_t begin, std::uint32_t count, Gathered& block) {
  const Garment& g = *in.garment;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const std::uint32_t h = begin + std::min(lane, count - 1);
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t p = g.hinge_particle[k][h];
      block.position[k].set(lane, in.position[p]);
      block.velocity[k].set(lane, in.velocity[p]);
      block.inverse_mass[k][lane] = in.inverse_mass[p];
    }
    block.stiffness[lane] = in.stiffness * g.hinge_bound[h];
    block.rest_angle[lane] = g.hinge_rest_angle[h];
  }
}

PLEAT_KERNEL void turn(const Gathered& in, float safe_rate, float bound, HingeBlock& out, float* turned) {
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const Vec3 x0 = in.position[0][lane], x1 = in.position[1][lane];
    const Vec3 x2 = in.position[2][lane], x3 = in.position[3][lane];
    const Vec3 e = x1 - x0;
    const Vec3 na = cross(e, x2 - x0), nb = cross(x3 - x0, e);
    const float na2 = dot(na, na), nb2 = dot(nb, nb), e_length = length(e);
    const float least = std::min(std::min(na2, nb2) * (1.0f / 4e-24f), e_length * (1.0f / 1e-9f));  // >= 1: has extent

    const Vec3 u = e * (1.0f / (least < 1.0f ? 1.0f : e_length));
    const Vec3 a = na * (1.0f / (least < 1.0f ? 1.0f : na2)), b = nb * (1.0f / (least < 1.0f ? 1.0f : nb2));
    const Vec3 g0 = -(a * dot(x2 - x1, u) + b * dot(x3 - x1, u)), g1 = a * dot(x2 - x0, u) + b * dot(x3 - x0, u);
    const Vec3 g2 = a * -e_length, g3 = b * -e_length;
    const float w0 = in.inverse_mass[0][lane], w1 = in.inverse_mass[1][lane];
    const float w2 = in.inverse_mass[2][lane], w3 = in.inverse_mass[3][lane];
    const float yielding = w0 * dot(g0, g0) + w1 * dot(g1, g1) + w2 * dot(g2, g2) + w3 * dot(g3, g3);
    const float speed = dot(g0, in.velocity[0][lane]) + dot(g1, in.velocity[1][lane]) + dot(g2, in.velocity[2][lane]) +
                        dot(g3, in.velocity[3][lane]);
    const float yields = yielding > 0.0f ? yielding : 1.0f;

    const float theta = angle_of(-e_length * dot(na, x3 - x0), dot(na, nb));
    const float highest = bound / yields, stiffness = in.stiffness[lane];
    const float softness = stiffness > highest ? std::sqrt(highest / stiffness) : 1.0f;
    const float here = least < 1.0f ? 0.0f : yielding > 0.0f ? 1.0f : 0.0f;
    turned[lane] = here * (softness * angle_between(theta, in.rest_angle[lane]));
    out.softness[lane] = softness;
    out.damping[lane] = safe_rate / yields * speed;
    out.gradient[0].set(lane, g0 * here);
    out.gradient[1].set(lane, g1 * here);
    out.gradient[2].set(lane, g2 * here);
    out.gradient[3].set(lane, g3 * here);
  }
}

/// Reads into the hinge columns' padding.
PLEAT_KERNEL void bend(const HingeBending& in, std::uint32_t begin, const float* turned, HingeBlock& block) {
  const Garment& g = *in.garment;
  float beside[4][kLanes];
  for (int k = 0; k < 4; ++k) {
    const std::uint32_t* index = g.hinge_beside[k].data() + begin;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) beside[k][lane] = turned[index[lane]];
  }
  const float* shape = g.hinge_shape.data() + begin;
  const float *c0 = g.hinge_coupling[0].data() + begin, *c1 = g.hinge_coupling[1].data() + begin;
  const float *c2 = g.hinge_coupling[2].data() + begin, *c3 = g.hinge_coupling[3].data() + begin;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const float sum = shape[lane] * turned[begin + lane] + c0[lane] * beside[0][lane] + c1[lane] * beside[1][lane] +
                      c2[lane] * beside[2][lane] + c3[lane] * beside[3][lane];
    const float moment = -(in.stiffness * block.softness[lane] * sum + block.damping[lane]);
    for (int k = 0; k < 4; ++k) block.gradient[k].set(lane, block.gradient[k][lane] * moment);
  }
}

PLEAT_KERNEL void scatter(const HingeBending& in, std::uint32_t begin, std::uint32_t count, const HingeBlock& block) {
  for (std::uint32_t lane = 0; lane < count; ++lane) {
    for (int k = 0; k < 4; ++k) in.force.add(in.garment->hinge_particle[k][begin + lane], block.gradient[k][lane]);
  }
}

PLEAT_KERNEL void bend_all(const HingeBending& in) {
  const float safe_rate = std::min(in.damping_rate, 0.2f / in.dt), bound = 0.2f / (in.dt * in.dt);
  const std::uint32_t hinges = in.garment->hinge_count;
  HingeBlock* blocks = in.scratch->blocks.data();
  float* turned = in.scratch->turn.data();
  for (std::uint32_t begin = 0; begin < hinges; begin += kLanes) {
    Gathered block;
    gather(in, begin, std::min(kLanes, hinges - begin), block);
    turn(block, safe_rate, bound, blocks[begin / kLanes], turned + begin);
  }
  for (std::uint32_t begin = 0; begin < hinges; begin += kLanes) {
    bend(in, begin, turned, blocks[begin / kLanes]);
    scatter(in, begin, std::min(kLanes, hinges - begin), blocks[begin / kLanes]);
  }
}

}  // namespace

bool HingeBending::validate() const {
  return garment != nullptr && position.x != nullptr && velocity.x != nullptr && inverse_mass != nullptr &&
         scratch != nullptr && scratch->turn.size() >= garment->hinge_count && force.x != nullptr &&
         stiffness >= 0.0f && damping_rate >= 0.0f && dt > 0.0f;
}

void HingeBending::run(VectorSet set) const {
  run_wide(set, [this] { bend_all(*this); });
}

}  // namespace pleat
