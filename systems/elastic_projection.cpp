#include "systems/elastic_projection.h"

#include <algorithm>
#include <cmath>

#include "components/lanes.h"
#include "components/pull_direction.h"
#include "components/wide.h"

namespace pleat {
namespace {

PLEAT_KERNEL void project(const ElasticProjection& in) {
  const std::uint32_t* first = in.garment->edge_particle[0].data();
  const std::uint32_t* second = in.garment->edge_particle[1].data();
  const float* rest_length = in.garment->edge_rest_length.data();
  const EdgeLine straight = in.law.straight(), buckled = in.law.buckled();
  const float dt2 = in.dt * in.dt;
  const float soft = 1.0f / (straight.stiffness * dt2), softer = 1.0f / (buckled.stiffness * dt2);  // kg
  const float shortest = 1.0f - in.law.buckling;
  Vec4* packed = in.packed->position.data();
  const Vec4* previous = in.packed->previous.data();
  for (std::uint32_t e = 0; e < in.garment->edge_count; ++e) {
    const std::uint32_t i = first[e], j = second[e];
    const Four a = load_four(packed[i]), b = load_four(packed[j]), d = way_between(a, b);
    const Four way = pull_direction(d, way_between(load_four(previous[i]), load_four(previous[j])));
    const float wi = a[3], wj = b[3], rest = rest_length[e], l = std::sqrt(dot(d, d));
    const float yielding = (wi + wj) * dot(way, d) / std::max(l, 1e-9f);
    float share = (l - straight.rest * rest) / (soft * rest + yielding);
    if (l - share * yielding < shortest * rest) share = (l - buckled.rest * rest) / (softer * rest + yielding);
    const Four pull = way * share;
    store(a + pull * wi, packed[i]);
    store(b - pull * wj, packed[j]);
  }
}

}  // namespace

bool ElasticProjection::validate() const {
  return garment != nullptr && inverse_mass != nullptr && previous.x != nullptr && position.x != nullptr &&
         law.stiffness > 0.0f && law.buckling >= 0.0f && dt > 0.0f && packed != nullptr &&
         packed->holds(garment->particle_count);
}

void ElasticProjection::run() const {
  run_wide(widest_vectors(), [this] {
    pack(position, inverse_mass, garment->particle_count, packed->position.data());
    pack(previous, nullptr, garment->particle_count, packed->previous.data());
    project(*this);
    unpack(packed->position.data(), garment->particle_count, position);
  });
}

}  // namespace pleat
