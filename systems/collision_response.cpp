#include "systems/collision_response.h"

namespace pleat {
namespace {

std::uint64_t& count_of(const ContactRow& row, Stats& stats) {
  return row.at_particle() ? stats.particle_contacts : row.with_itself() ? stats.self_contacts : stats.face_contacts;
}

}  // namespace

bool CollisionResponse::validate() const {
  return contacts.count != nullptr && (contacts.rows != nullptr || contacts.capacity == 0) && inverse_mass != nullptr &&
         position.x != nullptr;
}

void CollisionResponse::run(Stats& stats) const {
  for (std::uint32_t c = 0; c < *contacts.count; ++c) {
    ContactRow& row = contacts.rows[c];
    const float depth = row.offset - dot(row.normal, contact_point(row, position));
    if (!(depth > 0.0f)) continue;
    if (row.push == 0.0f) ++count_of(row, stats);
    row.push += depth;
    if (face_response == FaceResponse::kWeighted || row.with_itself()) {
      shift_contact(row, row.normal * depth, inverse_mass, position);
      continue;
    }
    for (std::uint32_t k = 0; k < row.count; ++k) {
      const bool moves = row.weight[k] > 0.0f && inverse_mass[row.particle[k]] > 0.0f;
      if (moves) position.add(row.particle[k], row.normal * depth);
    }
  }
}

}  // namespace pleat
