#include "systems/collision_response.h"

namespace pleat {

bool CollisionResponse::validate() const {
  return contacts.count != nullptr && (contacts.rows != nullptr || contacts.capacity == 0) && inverse_mass != nullptr &&
         position.x != nullptr;
}

void CollisionResponse::run(Stats& stats) const {
  for (std::uint32_t c = 0; c < *contacts.count; ++c) {
    ContactRow& row = contacts.rows[c];
    const float depth = row.offset - dot(row.normal, contact_point(row, position));
    if (!(depth > 0.0f)) continue;
    if (row.push == 0.0f) ++(row.at_particle ? stats.particle_contacts : stats.face_contacts);
    row.push += depth;
    if (face_response == FaceResponse::kWeighted) {
      shift_contact(row, row.normal * depth, inverse_mass, position);
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const bool moves = row.weight[k] > 0.0f && inverse_mass[row.particle[k]] > 0.0f;
      if (moves) position.add(row.particle[k], row.normal * depth);
    }
  }
}

}  // namespace pleat
