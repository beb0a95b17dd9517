#include "systems/elastic_projection.h"

#include <algorithm>
#include <cmath>

#include "components/lanes.h"
#include "components/pull_direction.h"
#include "components/wide.h"

namespace pleat {
namespace {

constexpr float kTiny = 1e-30f;  // what an edge without length is divided by

PLEAT_KERNEL void project(const ElasticProjection& in) {
  const std::uint32_t* first = in.garment->edge_particle[0].data();
  const std::uint32_t* second = in.garment->edge_particle[1].data();
  const float* rest_length = in.garment->edge_rest_length.data();
  const EdgeLine straight = in.law.straight(), buckled = in.law.buckled();
  const float dt2 = in.dt * in.dt;
  const float soft = 1.0f / (straight.stiffness * dt2), softer = 1.0f / (buckled.stiffness * dt2);  // kg
  const std::uint32_t count = in.garment->edge_count;
  const Vec4* ways = in.way;
  Vec4* packed = in.packed->position.data();
  for (std::uint32_t e = 0; e < count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const Four a = load_four(packed[i]), b = load_four(packed[j]), d = way_between(a, b);
    const float wi = a[3], wj = b[3], rest = rest_length[e], l2 = dot(d, d), l = std::sqrt(l2);
    const auto [way, along] = pull_direction(d, l2, load_four(ways[e]));
    const float yielding = (wi + wj) * along, inertia = rest * l;
    const float share = (l - straight.rest * rest) * l / std::max(soft * inertia + yielding, kTiny);
    const float buckled_share = (l - buckled.rest * rest) * l / std::max(softer * inertia + yielding, kTiny);
    const Four pull = way * std::max(share, buckled_share);  // the law is the larger of its two lines
    store(a + pull * wi, packed[i]);
    store(b - pull * wj, packed[j]);
  }
}

}  // namespace

bool ElasticProjection::validate() const {
  return garment != nullptr && inverse_mass != nullptr && way != nullptr && position.x != nullptr &&
         law.stiffness > 0.0f && law.buckling >= 0.0f && dt > 0.0f && packed != nullptr &&
         packed->holds(garment->particle_count);
}

void ElasticProjection::run() const {
  run_wide(widest_vectors(), [this] {
    pack(position, inverse_mass, garment->particle_count, packed->position.data());
    project(*this);
    unpack(packed->position.data(), garment->particle_count, position);
  });
}

}  // namespace pleat
