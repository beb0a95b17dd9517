#include "systems/plane_detection.h"

#include "systems/contact_row.h"

namespace pleat {

bool PlaneDetection::validate() const {
  return position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         (planes != nullptr || plane_count == 0) && contacts.count != nullptr && thickness >= 0.0f &&
         friction >= 0.0f && dt > 0.0f && t0 >= 0.0f && t0 < t1 && t1 <= 1.0f;
}

void PlaneDetection::run(Stats& stats) const {
  const float reach = thickness + contact_margin(position, previous, particle_count);
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  for (std::size_t k = 0; k < plane_count; ++k) {
    const PlaneCollider& plane = planes[k];
    if (!plane.meets(collides_with)) continue;
    const PlanePose pose(plane, t1, origin);
    const RigidPose from = plane.previous.from(origin), to = plane.next.from(origin);
    const RigidStep step(interpolate(from, to, t0), interpolate(from, to, t1));
    for (std::uint32_t i = 0; i < particle_count; ++i) {
      const float above = dot(pose.normal, position[i]) - pose.height;
      if (!(above < reach)) continue;
      const Vec3 surface = position[i] - pose.normal * above;
      rows.add({i, i, i}, {1.0f, 0.0f, 0.0f}, pose.normal, surface, thickness, step.at(surface), plane.friction, 1,
               stats);
    }
  }
}

}  // namespace pleat
