#include "systems/contact_friction.h"

#include <algorithm>

#include "components/wide.h"

namespace pleat {

bool ContactFriction::validate() const {
  return contacts.count != nullptr && (contacts.rows != nullptr || contacts.capacity == 0) && previous != nullptr &&
         longest >= 0.0f && position != nullptr;
}

void ContactFriction::run() const {
  run_wide(widest_vectors(), [&] {
    for (std::uint32_t c = 0; c < *contacts.count; ++c) {
      ContactRow& row = contacts.rows[c];
      const float most = row.friction * row.push - row.rubbed;
      if (!(most > 0.0f)) continue;
      const Vec3 moved = contact_point(row, position) - contact_point(row, previous) - row.body_step;
      const Vec3 slid = moved - row.normal * dot(row.normal, moved);
      const float distance = length(slid);
      if (distance < 1e-12f || distance > longest) continue;
      const float share = std::min(1.0f, most / distance);
      shift_contact(row, slid * -share, position);
      row.rubbed += share * distance;
    }
  });
}

bool ContactVelocity::validate() const {
  return contacts.count != nullptr && (contacts.rows != nullptr || contacts.capacity == 0) && dt > 0.0f &&
         velocity.x != nullptr;
}

void ContactVelocity::run() const {
  for (std::uint32_t c = 0; c < *contacts.count; ++c) {
    const ContactRow& row = contacts.rows[c];
    if (row.push == 0.0f) continue;
    const float leaving = dot(row.normal, contact_point(row, velocity) - row.body_step * (1.0f / dt));
    if (leaving > 0.0f) shift_contact(row, row.normal * -leaving, velocity);
  }
}

}  // namespace pleat
