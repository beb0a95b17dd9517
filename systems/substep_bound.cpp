#include "systems/substep_bound.h"

#include <algorithm>
#include <cmath>

#include "systems/contact_row.h"

namespace pleat {
namespace {

constexpr float kLeastReach = 1e-4f;  // m, of a body without extent against a cloth without thickness

/// The longest way that a vertex goes beside `carried`, m; 0 for a mesh that stays clear of `cloth`.
float motion_near(const Box& cloth, const MeshCollider& mesh, const Vec3& carried) {
  const ConstVec3View from = mesh.previous.view(), to = mesh.next.view();
  const Box swept = box_of(from, mesh.previous.size()).with(box_of(to, mesh.next.size())).grown(mesh.bow);
  if (!swept.overlaps(cloth)) return 0.0f;
  float most2 = 0.0f;
  for (std::size_t i = 0; i < mesh.next.size(); ++i) {
    const Vec3 d = to[i] - from[i] - carried;
    most2 = std::max(most2, dot(d, d));
  }
  return std::sqrt(most2) + mesh.bow;
}

}  // namespace

bool SubstepBound::validate() const {
  return position.x != nullptr && velocity.x != nullptr && capsules != nullptr && bodies != nullptr &&
         (meshes != nullptr || mesh_count == 0) && thickness >= 0.0f && dt > 0.0f;
}

std::uint32_t SubstepBound::run() const {
  Vec3 carried;  // u dt
  for (std::size_t i = 0; i < particle_count; ++i) carried += velocity[i];
  carried = carried * (dt / static_cast<float>(std::max<std::size_t>(particle_count, 1)));
  float own2 = 0.0f;
  for (std::size_t i = 0; i < particle_count; ++i) {
    const Vec3 d = velocity[i] * dt - carried;
    own2 = std::max(own2, dot(d, d));
  }
  const float own = std::sqrt(own2);
  const Box cloth = box_of(position, particle_count).grown(own + length(carried) + thickness).moved(origin);

  const ConstVec3View a0 = capsules->previous_a.view(), a1 = capsules->next_a.view();
  const ConstVec3View b0 = capsules->previous_b.view(), b1 = capsules->next_b.view();
  float most = 1.0f;
  bodies->for_each_capsule(cloth, [&](std::uint32_t i) {
    Box swept;
    for (const Vec3& end : {a0[i], a1[i], b0[i], b1[i]}) swept.include(end);
    const float radius = capsules->radius[i], taper = capsules->taper[i];
    if (!swept.grown(radius + std::max(taper, 0.0f)).overlaps(cloth)) return;
    const float reach = radius + std::min(taper, 0.0f) + capsules->thickness[i] + thickness;
    const float motion = std::max(length(a1[i] - a0[i] - carried), length(b1[i] - b0[i] - carried));
    most = std::max(most, (motion + own) / std::max(0.5f * reach, kLeastReach));
  });
  for (std::uint32_t m = 0; m < mesh_count; ++m) {
    if (!meshes[m]->enabled) continue;
    const float motion = motion_near(cloth, *meshes[m], carried);
    if (motion > 0.0f) most = std::max(most, (motion + own) / (kLeastMargin + meshes[m]->thickness + thickness));
  }
  return static_cast<std::uint32_t>(std::ceil(std::min(most, static_cast<float>(kMost))));
}

}  // namespace pleat
