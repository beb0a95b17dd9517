#include "systems/hinge_bending.h"

#include <algorithm>
#include <numbers>

#include "components/hinge_gradient.h"
#include "components/wide.h"
#include "systems/angle.h"

namespace pleat {
namespace {

/// theta - theta0 the short way round: a hinge that rests near a full fold must not jump by a turn.
PLEAT_KERNEL Lanes angle_between(const Lanes& theta, const Lanes& rest) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const Lanes d = theta - rest;
  return d > kPi ? d - 2.0f * kPi : d < -kPi ? d + 2.0f * kPi : d;
}

PLEAT_KERNEL void turn(const HingeBending& in, std::uint32_t begin, float safe_rate, float bound, float step_damping,
                       HingeBlock& out, float* turned) {
  const Garment& g = *in.garment;
  MotionLanes at[4];
  for (std::size_t k = 0; k < 4; ++k) at[k] = gather(in.packed->motion.data(), g.hinge_particle[k].data() + begin);
  const HingeGradient<Lanes> hinge(at[0].position, at[1].position, at[2].position, at[3].position);
  Lanes yielding{}, speed{};
  for (std::size_t k = 0; k < 4; ++k) {
    yielding += at[k].inverse_mass * dot(hinge.at[k], hinge.at[k]);
    speed += dot(hinge.at[k], at[k].velocity);
  }
  const Lanes one = all(1.0f);
  const LaneMask bends = hinge.has_extent & (yielding > 0.0f);
  const Lanes yields = bends ? yielding : one, here = bends ? one : Lanes{};

  const Lanes theta = angle_of(-hinge.length * dot(hinge.na, at[3].position - at[0].position), dot(hinge.na, hinge.nb));
  const Lanes inverse = 1.0f / yields;
  const Lanes highest = bound * inverse, stiffness = in.stiffness * load(g.hinge_bound.data() + begin);
  out.softness = one;
  if (any(stiffness > highest)) out.softness = stiffness > highest ? sqrt(highest / stiffness) : one;
  const Lanes stepped = min(step_damping * stiffness, (0.2f / in.dt) * inverse);
  out.damping = max(safe_rate * inverse, stepped) * speed;
  for (std::size_t k = 0; k < 4; ++k) out.gradient[k] = hinge.at[k] * here;
  store(here * (out.softness * angle_between(theta, load(g.hinge_rest_angle.data() + begin))), turned + begin);
}

PLEAT_KERNEL void bend(const HingeBending& in, std::uint32_t begin, const float* turned, const HingeBlock& block) {
  const Garment& g = *in.garment;
  Lanes sum = load(g.hinge_shape.data() + begin) * load(turned + begin);
  for (std::size_t k = 0; k < 4; ++k) {
    sum += load(g.hinge_coupling[k].data() + begin) * gather(turned, g.hinge_beside[k].data() + begin);
  }
  const Lanes moment = -(in.stiffness * block.softness * sum + block.damping);
  const std::uint32_t count = std::min(kLanes, g.hinge_count - begin);
  for (std::size_t k = 0; k < 4; ++k) {
    scatter_add(block.gradient[k] * moment, g.hinge_particle[k].data() + begin, count, in.packed->force.data());
  }
}

/// Reads into the hinge columns' padding.
PLEAT_KERNEL void bend_all(const HingeBending& in) {
  const float safe_rate = std::min(in.damping_rate, 0.2f / in.dt), bound = 0.2f / (in.dt * in.dt);
  const float step_damping = in.step_damping * in.dt;
  const std::uint32_t hinges = in.garment->hinge_count;
  HingeBlock* blocks = in.scratch->blocks.data();
  float* turned = in.scratch->turn.data();
  for (std::uint32_t begin = 0; begin < hinges; begin += kLanes) {
    turn(in, begin, safe_rate, bound, step_damping, blocks[begin / kLanes], turned);
  }
  for (std::uint32_t begin = 0; begin < hinges; begin += kLanes) bend(in, begin, turned, blocks[begin / kLanes]);
}

}  // namespace

bool HingeBending::validate() const {
  return garment != nullptr && position.x != nullptr && velocity.x != nullptr && inverse_mass != nullptr &&
         packed != nullptr && packed->holds(garment->particle_count) && scratch != nullptr &&
         scratch->turn.size() >= garment->hinge_count && force.x != nullptr && stiffness >= 0.0f &&
         damping_rate >= 0.0f && dt > 0.0f && step_damping >= 0.0f;
}

void HingeBending::run(VectorSet set) const {
  run_wide(set, [this] {
    const std::size_t count = garment->particle_count;
    pack_state(position, inverse_mass, velocity, force, count, *packed);
    bend_all(*this);
    unpack(packed->force.data(), count, force);
  });
}

}  // namespace pleat
