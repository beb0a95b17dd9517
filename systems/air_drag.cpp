#include "systems/air_drag.h"

#include <algorithm>

namespace pleat {

bool AirDrag::validate() const {
  return garment != nullptr && position.x != nullptr && velocity.x != nullptr && force.x != nullptr &&
         is_finite(wind) && air_density >= 0.0f && drag_coefficient >= 0.0f && lift_coefficient >= 0.0f &&
         density > 0.0f && dt > 0.0f;
}

void AirDrag::run() const {
  for (std::uint32_t f = 0; f < garment->face_count; ++f) {
    const std::uint32_t a = garment->face_particle[0][f], b = garment->face_particle[1][f],
                        c = garment->face_particle[2][f];
    const Vec3 twice_area = cross(position[b] - position[a], position[c] - position[a]);
    const float l = length(twice_area);
    if (l < 1e-12f) continue;
    const Vec3 n = twice_area * (1.0f / l);
    const Vec3 v = (velocity[a] + velocity[b] + velocity[c]) * (1.0f / 3.0f) - wind;
    const float vn = dot(v, n), slip = std::max(length(v) - std::abs(vn), 0.0f);
    const float pressure = 0.5f * air_density * (drag_coefficient * std::abs(vn) + lift_coefficient * slip);
    const float most = density * garment->face_rest_area[f] / dt;
    const float coefficient = std::min(pressure * 0.5f * l, most);
    const Vec3 third = n * (coefficient * vn * (-1.0f / 3.0f));
    force.add(a, third);
    force.add(b, third);
    force.add(c, third);
  }
}

}  // namespace pleat
