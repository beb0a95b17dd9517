#include "systems/elastic_projection.h"

#include "components/pull_direction.h"
#include "systems/edge_pass.h"

namespace pleat {
namespace {

constexpr float kTiny = 1e-30f;  // m2/kg, what an edge without length is divided by

PLEAT_KERNEL void project(const ElasticProjection& in, VectorSet set) {
  const EdgeLine straight = in.law.straight(), buckled = in.law.buckled();
  const float dt2 = in.dt * in.dt;
  const float soft = 1.0f / (straight.stiffness * dt2), softer = 1.0f / (buckled.stiffness * dt2);  // 1/kg
  for_each_edge(*in.garment, in.way, in.packed->position, set, [&](const auto& edge) {
    const auto a = edge.end(0), b = edge.end(1);
    const auto d = b.vector - a.vector;
    const auto rest = edge.rest_length(), l2 = dot(d, d), l = sqrt(l2), inertia = rest * l;
    const auto [way, along] = pull_direction(d, l2, edge.way());
    const auto yielding = (a.w + b.w) * along;
    const auto pull_of = [&](const EdgeLine& line, float softness) {
      return (l - line.rest * rest) * l / max(softness * inertia + yielding, decltype(l){} + kTiny);
    };
    const auto pull = way * max(pull_of(straight, soft), pull_of(buckled, softer));  // the law is the larger of the two
    edge.put(0, a.vector + pull * a.w, a.w);
    edge.put(1, b.vector - pull * b.w, b.w);
  });
}

}  // namespace

bool ElasticProjection::validate() const {
  return garment != nullptr && inverse_mass != nullptr && way.x != nullptr && position.x != nullptr &&
         law.stiffness > 0.0f && law.buckling >= 0.0f && dt > 0.0f && packed != nullptr &&
         packed->holds(garment->particle_count);
}

void ElasticProjection::run(VectorSet set) const {
  run_wide(set, [&] {
    pack(position, inverse_mass, garment->particle_count, packed->position.data());
    project(*this, set);
    unpack(packed->position.data(), garment->particle_count, position);
  });
}

}  // namespace pleat
