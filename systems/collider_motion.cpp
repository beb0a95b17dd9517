#include "systems/collider_motion.h"

#include "systems/capsule_shape.h"

namespace pleat {
namespace {

constexpr float kSkin = 0.1f;  // m, that is sought besides

}  // namespace

bool ColliderMotion::validate() const {
  return capsules != nullptr && bodies != nullptr && position.x != nullptr && poses != nullptr &&
         pose_count != nullptr && sought != nullptr && reach >= 0.0f && t0 >= 0.0f && t0 <= t1 && t1 <= 1.0f;
}

void ColliderMotion::run(Stats& stats) const {
  const Box near = box_of(position, particle_count).grown(reach);
  if (!sought->holds(near)) {
    *sought = near.grown(kSkin);
    if (seek(*sought) > capacity) {  // then none may take the place of a nearer one
      *sought = {};
      stats.contacts_dropped += seek(near) - *pose_count;
    }
  }
  const ConstVec3View a0 = capsules->previous_a.view(), a1 = capsules->next_a.view();
  const ConstVec3View b0 = capsules->previous_b.view(), b1 = capsules->next_b.view();
  for (std::uint32_t k = 0; k < *pose_count; ++k) {
    const std::uint32_t i = poses[k].index;
    poses[k] = {.a = lerp(a0[i] - origin, a1[i] - origin, t1),
                .b = lerp(b0[i] - origin, b1[i] - origin, t1),
                .step_a = (a1[i] - a0[i]) * (t1 - t0),
                .step_b = (b1[i] - b0[i]) * (t1 - t0),
                .radius = capsules->radius[i] + capsules->thickness[i],
                .taper = capsules->taper[i],
                .friction = capsules->friction[i],
                .index = i};
    drop_swallowed_end(poses[k]);
  }
}

std::uint32_t ColliderMotion::seek(const Box& box) const {
  std::uint32_t found = 0;
  bodies->for_each_capsule(box.moved(origin), [&](std::uint32_t i) {
    if (!capsules->meets(i, collides_with)) return;
    if (found < capacity) poses[found].index = i;
    ++found;
  });
  const std::uint32_t count = std::min(found, capacity);
  // The tree's order depends on its history; a cloth's motion must not.
  std::sort(poses, poses + count, [](const CapsulePose& p, const CapsulePose& q) { return p.index < q.index; });
  *pose_count = count;
  return found;
}

}  // namespace pleat
