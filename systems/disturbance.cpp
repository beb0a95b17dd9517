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
  return garment != nullptr && position.x != nullptr && bodies.capsules != nullptr && reach >= 0.0f &&
         (garment->pins.size() == 0 || (pin_previous.x != nullptr && pin_next.x != nullptr));
}

bool Disturbance::run() const {
  if (garment->pins.size() != 0 && moves(pin_previous, pin_next, garment->pins.size())) return true;
  const Box cloth = box_of(position, garment->particle_count).grown(reach).moved(origin);
  const auto passes = [&](const Box& from, const Box& to, float around) {
    if (on_the_way) return from.with(to).grown(around).overlaps(cloth);
    return from.grown(around).overlaps(cloth) || to.grown(around).overlaps(cloth);
  };
  const CapsuleColumns* const capsules = bodies.capsules;
  const ConstVec3View a0 = capsules->previous_a.view(), a1 = capsules->next_a.view();
  const ConstVec3View b0 = capsules->previous_b.view(), b1 = capsules->next_b.view();
  for (std::size_t i = 0; i < capsules->size(); ++i) {
    if (!capsules->meets(i, bodies.collides_with) || (a0[i] == a1[i] && b0[i] == b1[i])) continue;
    Box from, to;
    from.include(a0[i]), from.include(b0[i]), to.include(a1[i]), to.include(b1[i]);
    const float radius = capsules->radius[i] + std::max(capsules->taper[i], 0.0f) + capsules->thickness[i];
    if (passes(from, to, radius)) return true;
  }
  for (const MeshCollider* mesh : bodies.meshes) {
    const ConstVec3View from = mesh->previous.view(), to = mesh->next.view();
    const std::size_t count = mesh->next.size();
    if (!mesh->meets(bodies.collides_with) || !moves(from, to, count)) continue;
    if (passes(box_of(from, count), box_of(to, count), mesh->bow + mesh->thickness)) return true;
  }
  return std::any_of(bodies.planes.begin(), bodies.planes.end(), [this](const PlaneCollider& plane) {
    return plane.meets(bodies.collides_with) && !(plane.previous == plane.next);
  });
}

float largest_speed(std::size_t count, const ConstVec3View& velocity) {
  float most2 = 0.0f;
  for (std::size_t i = 0; i < count; ++i) most2 = std::max(most2, dot(velocity[i], velocity[i]));
  return std::sqrt(most2);
}

}  // namespace pleat
