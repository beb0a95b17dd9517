// Contact rows: one inequality each,  n . (sum of b_k x_k) >= d,  over up to four particles of the cloth.
//   against a body:   one particle, b = (1), or the corners of a face, b the barycentrics of the touching point; sum 1;
//   against itself:   a particle and the corners of a face, b = (1, -b0, -b1, -b2): their difference; sum 0.
#pragma once

#include <cstdint>

#include "components/lanes.h"

namespace pleat {

struct ContactRow {
  std::uint32_t particle[4];  // cloth-local
  float weight[4];
  Vec3 normal;          // out of the body, unit
  float offset;         // d, m
  Vec3 body_step;       // motion of the touched point of the body over the substep, m
  float friction;       // Coulomb coefficient of the pair
  float share[4];       // of a shift of the point, each particle's: w_k b_k / (sum of w b^2), or less (contact_row.h)
  std::uint32_t count;  // of particles: 1 to 4; 4 is the cloth against itself
  float push;           // m, total distance pushed in this substep's sweeps
  float rubbed;         // m, what friction has taken back of sliding in this substep

  bool at_particle() const { return count == 1; }
  bool with_itself() const { return count == 4; }
};

/// The row's point of a cloth-local column: sum of b_k x[particle_k].
inline Vec3 contact_point(const ContactRow& row, ConstVec3View x) {
  Vec3 point = x[row.particle[0]] * row.weight[0];
  for (std::uint32_t k = 1; k < row.count; ++k) point += x[row.particle[k]] * row.weight[k];
  return point;
}

/// The same of a packed column, the fourth number of which means nothing here.
inline Vec3 contact_point(const ContactRow& row, const Vec4* x) {
  Four point = load_four(x[row.particle[0]]) * row.weight[0];
  if (row.count > 1) point += load_four(x[row.particle[1]]) * row.weight[1];
  if (row.count > 2) point += load_four(x[row.particle[2]]) * row.weight[2];
  if (row.count > 3) point += load_four(x[row.particle[3]]) * row.weight[3];
  return {point[0], point[1], point[2]};
}

/// Moves the row's point by `shift`, each particle by its share.
inline void shift_contact(const ContactRow& row, const Vec3& shift, Vec3View x) {
  for (std::uint32_t k = 0; k < row.count; ++k) x.add(row.particle[k], shift * row.share[k]);
}
inline void shift_contact(const ContactRow& row, const Vec3& shift, Vec4* x) {
  const Four four{shift.x, shift.y, shift.z, 0.0f};
  const auto move = [&](std::uint32_t k) {
    Vec4& at = x[row.particle[k]];
    store(load_four(at) + four * row.share[k], at);
  };
  move(0);
  if (row.count > 1) move(1);
  if (row.count > 2) move(2);
  if (row.count > 3) move(3);
}

/// A fixed-capacity list of rows in the engine's scratch memory; filled once per substep.
struct ContactList {
  ContactRow* rows = nullptr;
  std::uint32_t capacity = 0;
  std::uint32_t* count = nullptr;

  bool add(const ContactRow& row) const {
    if (*count == capacity) return false;
    rows[(*count)++] = row;
    return true;
  }
};

}  // namespace pleat
