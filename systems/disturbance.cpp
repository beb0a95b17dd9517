#include "systems/disturbance.h"

#include <algorithm>
#include <cmath>

#include "systems/box.h"

namespace pleat {
namespace {

bool moves(const ConstVec3View& previous, const ConstVec3View& next, std::size_t count) {
  return !std::equal(previous.x, previous.x + count, next.x) || !std::equal(previous.y, previous.y + count, next.y) ||
         !std::equal(previous.z, previous.z + count, next.z);
}

}  // namespace

bool Disturbance::validate() const {
  return garment != nullptr && position.x != nullptr && capsules != nullptr && reach >= 0.0f &&
         (garment->pins.size() == 0 || (pin_previous.x != nullptr && pin_next.x != nullptr));
}

bool Disturbance::run() const {
  if (garment->pins.size() != 0 && moves(pin_previous, pin_next, garment->pins.size())) return true;
  const Box cloth = box_of(position, garment->particle_count).grown(reach).moved(origin);
  const ConstVec3View a0 = capsules->previous_a.view(), a1 = capsules->next_a.view();
  const ConstVec3View b0 = capsules->previous_b.view(), b1 = capsules->next_b.view();
  for (std::size_t i = 0; i < capsules->size(); ++i) {
    if (capsules->enabled[i] == 0 || (a0[i] == a1[i] && b0[i] == b1[i])) continue;
    Box swept;
    for (const Vec3& end : {a0[i], a1[i], b0[i], b1[i]}) swept.include(end);
    const float radius = capsules->radius[i] + std::max(capsules->taper[i], 0.0f) + capsules->thickness[i];
    if (swept.grown(radius).overlaps(cloth)) return true;
  }
  for (const MeshCollider* mesh : meshes) {
    const ConstVec3View from = mesh->previous.view(), to = mesh->next.view();
    const std::size_t count = mesh->next.size();
    if (!mesh->enabled || !moves(from, to, count)) continue;
    if (box_of(from, count).with(box_of(to, count)).grown(mesh->bow + mesh->thickness).overlaps(cloth)) return true;
  }
  return std::any_of(planes.begin(), planes.end(),
                     [](const PlaneCollider& plane) { return plane.enabled && !(plane.previous == plane.next); });
}

float largest_speed(std::size_t count, const ConstVec3View& velocity) {
  float most2 = 0.0f;
  for (std::size_t i = 0; i < count; ++i) most2 = std::max(most2, dot(velocity[i], velocity[i]));
  return std::sqrt(most2);
}

}  // namespace pleat
