#include "systems/substep_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "systems/contact_row.h"

namespace pleat {
namespace {

constexpr float kLeastRoom = 1e-4f;  // m, of a body without extent against a cloth without thickness

/// The longest way that a vertex goes beside the cloth, m; 0 for a mesh that stays clear of `cloth`.
template <class Carried>
float motion_near(const Box& cloth, const MeshCollider& mesh, const Carried& carried) {
  const ConstVec3View from = mesh.previous.view(), to = mesh.next.view();
  const Box swept = box_of(from, mesh.previous.size()).with(box_of(to, mesh.next.size())).grown(mesh.bow);
  if (!swept.overlaps(cloth)) return 0.0f;
  float most2 = 0.0f;
  for (std::size_t i = 0; i < mesh.next.size(); ++i) {
    const Vec3 d = to[i] - carried(from[i]);
    most2 = std::max(most2, dot(d, d));
  }
  return std::sqrt(most2) + mesh.bow;
}

/// A stretch of the way from a to b, as fractions; empty where first > last.
struct Stretch {
  float first = 0.0f, last = 1.0f;

  bool empty() const { return first > last; }
  /// What of it is between two planes across an axis.
  void clip(float a, float b, float low, float high) {
    if (a == b) {
      if (a < low || a > high) first = 1.0f, last = 0.0f;
      return;
    }
    const float in = (low - a) / (b - a), out = (high - a) / (b - a);
    first = std::max(first, std::min(in, out)), last = std::min(last, std::max(in, out));
  }
};

Stretch inside(const Box& box, const Vec3& a, const Vec3& b) {
  Stretch s;
  s.clip(a.x, b.x, box.low.x, box.high.x);
  s.clip(a.y, b.y, box.low.y, box.high.y);
  s.clip(a.z, b.z, box.low.z, box.high.z);
  return s;
}

}  // namespace

bool SubstepBound::validate() const {
  return position.x != nullptr && velocity.x != nullptr && capsules != nullptr && bodies != nullptr &&
         (meshes != nullptr || mesh_count == 0) && thickness >= 0.0f && dt > 0.0f && reach > 0.0f;
}

float SubstepBound::run() const {
  Vec3 mean;  // u dt
  float own = 0.0f;
  if (!carry) {
    for (std::size_t i = 0; i < particle_count; ++i) mean += velocity[i];
    mean = mean * (dt / static_cast<float>(std::max<std::size_t>(particle_count, 1)));
    float own2 = 0.0f;
    for (std::size_t i = 0; i < particle_count; ++i) {
      const Vec3 d = velocity[i] * dt - mean;
      own2 = std::max(own2, dot(d, d));
    }
    own = std::sqrt(own2);
  }
  const RigidMotion motion = carry.value_or(RigidMotion{}).moved(origin);
  const auto carried = [&](const Vec3& p) { return carry ? motion.apply(p) : p + mean; };
  Box cloth = box_of(position, particle_count).grown(own + length(mean) + thickness).moved(origin);
  if (carry) {
    for (std::size_t i = 0; i < particle_count; ++i) cloth.include(motion.apply(position[i] + origin));
  }

  const ConstVec3View a0 = capsules->previous_a.view(), a1 = capsules->next_a.view();
  const ConstVec3View b0 = capsules->previous_b.view(), b1 = capsules->next_b.view();
  const float most_room = carry ? kRecoverySpeed * dt : std::numeric_limits<float>::infinity();
  float most = 0.0f;
  bodies->for_each_capsule(cloth, [&](std::uint32_t i) {
    if (!capsules->meets(i, collides_with)) return;
    Box swept;
    for (const Vec3& end : {a0[i], a1[i], b0[i], b1[i]}) swept.include(end);
    const float radius = capsules->radius[i], taper = capsules->taper[i];
    if (!swept.grown(radius + std::max(taper, 0.0f)).overlaps(cloth)) return;
    const float room = std::clamp(reach * (radius + std::min(taper, 0.0f) + capsules->thickness[i] + thickness),
                                  kLeastRoom, std::max(most_room, kLeastRoom));
    const Vec3 way_a = a1[i] - carried(a0[i]), way_b = b1[i] - carried(b0[i]);
    // What is near at some time is no farther than half its way from being near as the tick begins or ends.
    const float half_way = 0.5f * std::max(length(a1[i] - a0[i]), length(b1[i] - b0[i]));
    const Box near = cloth.grown(radius + std::max(taper, 0.0f) + half_way);
    const Stretch begin = inside(near, a0[i], b0[i]), end = inside(near, a1[i], b1[i]);
    for (const Stretch& part : {begin, end}) {
      if (part.empty()) continue;
      for (const float s : {part.first, part.last}) {
        most = std::max(most, (length(way_a + (way_b - way_a) * s) + own) / room);
      }
    }
  });
  for (std::uint32_t m = 0; m < mesh_count; ++m) {
    if (!meshes[m]->meets(collides_with)) continue;
    const float way = motion_near(cloth, *meshes[m], carried);
    const float room = (carry ? reach : 1.0f) * (kLeastMargin + meshes[m]->thickness + thickness);
    if (way > 0.0f) most = std::max(most, (way + own) / std::min(room, most_room));
  }
  return std::min(most, kMost);
}

}  // namespace pleat
