#include "systems/collision_response.h"

#include "components/wide.h"

namespace pleat {
namespace {

std::uint64_t& count_of(const ContactRow& row, Stats& stats) {
  return row.at_particle() ? stats.particle_contacts : row.with_itself() ? stats.self_contacts : stats.face_contacts;
}

}  // namespace

bool CollisionResponse::validate() const {
  return contacts.count != nullptr && (contacts.rows != nullptr || contacts.capacity == 0) && position != nullptr;
}

void CollisionResponse::run(Stats& stats) const {
  run_wide(widest_vectors(), [&] {
    ContactRow* const end = contacts.rows + *contacts.count;
    for (ContactRow* row = contacts.rows; row != end; ++row) {
      const float depth = row->offset - dot(row->normal, contact_point(*row, position));
      if (!(depth > 0.0f)) continue;
      if (row->push == 0.0f) ++count_of(*row, stats);
      row->push += depth;
      if (face_response == FaceResponse::kWeighted || row->with_itself()) {
        shift_contact(*row, row->normal * depth, position);
        continue;
      }
      const Four shift{row->normal.x * depth, row->normal.y * depth, row->normal.z * depth, 0.0f};
      for (std::uint32_t k = 0; k < row->count; ++k) {
        Vec4& at = position[row->particle[k]];
        if (row->share[k] > 0.0f) store(load_four(at) + shift, at);
      }
    }
  });
}

}  // namespace pleat
