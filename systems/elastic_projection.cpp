#include "systems/elastic_projection.h"

#include "components/pull_direction.h"
#include "systems/edge_pass.h"

namespace pleat {
namespace {

constexpr float kTiny = 1e-30f;     // m2, what an edge without length is divided by
constexpr float kShortest = 1e-9f;  // m, of an edge that is damped

PLEAT_KERNEL void project(const ElasticProjection& in, VectorSet set) {
  const EdgeLine straight = in.law.straight(), buckled = in.law.buckled();
  const float dt2 = in.dt * in.dt, stiff = straight.stiffness * dt2, less_stiff = buckled.stiffness * dt2;  // kg
  const float damped = in.damping_rate * in.dt;
  for_each_edge(in.garment->slots, in.way, *in.position, set, [&](const auto& edge) PLEAT_KERNEL_LAMBDA {
    const auto a = edge.end(0), b = edge.end(1);
    const auto d = b.vector - a.vector, before = edge.way();
    const auto rest = edge.rest_length(), l2 = dot(d, d), l = sqrt(l2), inertia = max(rest * l, decltype(l){} + kTiny);
    const auto [way, along] = pull_direction(d, l2, before);
    const auto weight = a.w + b.w, yielding = weight * along;
    const auto l0 = max(sqrt(dot(before, before)), decltype(l){} + kShortest);
    const auto drag = damped * rest / (l0 * (weight > 0.0f ? weight : decltype(l){} + 1.0f));  // kg
    const auto braked = drag * (l - l0);
    const auto pull_of = [&](const EdgeLine& line, float mass) {
      return (mass * (l - line.rest * rest) + braked) * l / (inertia + (mass + drag) * yielding);
    };
    const auto pull = way * max(pull_of(straight, stiff), pull_of(buckled, less_stiff));  // the law is the larger one
    edge.put(0, a.vector + pull * a.w, a.w);
    edge.put(1, b.vector - pull * b.w, b.w);
  });
}

}  // namespace

bool ElasticProjection::validate() const {
  return garment != nullptr && way.x != nullptr && position != nullptr &&
         position->size() > garment->slots.empty_place + 1 && law.stiffness > 0.0f && law.buckling >= 0.0f &&
         damping_rate >= 0.0f && dt > 0.0f;
}

void ElasticProjection::run(VectorSet set) const {
  run_wide(set, [&] {
    for (std::uint32_t pass = 0; pass < passes; ++pass) project(*this, set);
  });
}

}  // namespace pleat
