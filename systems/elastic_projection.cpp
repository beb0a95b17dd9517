#include "systems/elastic_projection.h"

#include "components/lanes.h"
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
  for (std::uint32_t e = 0; e < in.garment->edge_count; ++e) {
    Vec4 &a = in.packed[first[e]], &b = in.packed[second[e]];
    const float wi = a.w, wj = b.w, rest = rest_length[e];
    const Vec3 d{b.x - a.x, b.y - a.y, b.z - a.z};
    const float l = length(d), yielding = (wi + wj) * l;
    float share = (l - straight.rest * rest) / (soft * rest + yielding);
    if (l - share * yielding < shortest * rest) share = (l - buckled.rest * rest) / (softer * rest + yielding);
    const Vec3 pull = d * share;
    a = {a.x + pull.x * wi, a.y + pull.y * wi, a.z + pull.z * wi, wi};
    b = {b.x - pull.x * wj, b.y - pull.y * wj, b.z - pull.z * wj, wj};
  }
}

}  // namespace

bool ElasticProjection::validate() const {
  return garment != nullptr && inverse_mass != nullptr && position.x != nullptr && law.stiffness > 0.0f &&
         law.buckling >= 0.0f && dt > 0.0f && packed != nullptr;
}

void ElasticProjection::run() const {
  run_wide(widest_vectors(), [this] {
    pack(position, inverse_mass, garment->particle_count, packed);
    project(*this);
    unpack(packed, garment->particle_count, position);
  });
}

}  // namespace pleat
