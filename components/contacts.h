// Contact rows: one inequality each,  n . (b0 x0 + b1 x1 + b2 x2) >= d,  for a point of the cloth with barycentrics b
// on three of its particles. A contact at a particle has b = (1, 0, 0); on an edge one weight is zero.
#pragma once

#include <cstdint>

#include "components/column.h"

namespace pleat {

struct ContactRow {
  std::uint32_t particle[3];  // cloth-local; all three valid even where the weight is zero
  float weight[3];            // barycentrics, sum 1
  Vec3 normal;                // out of the body, unit
  float offset;               // d, m
  Vec3 body_step;             // motion of the touched point of the body over the substep, m
  float friction;             // Coulomb coefficient of the pair
  float inverse_mass;         // 1/kg, sum of w_i b_i^2, or more near pins: how the point yields
  float push;                 // m, total distance pushed in this substep's sweeps
  bool at_particle;           // a particle row, as against one on an edge or a face
};

/// The row's point of a cloth-local column: sum of b_k x[particle_k].
inline Vec3 contact_point(const ContactRow& row, ConstVec3View x) {
  return x[row.particle[0]] * row.weight[0] + x[row.particle[1]] * row.weight[1] + x[row.particle[2]] * row.weight[2];
}

/// Moves the row's point by `shift`, each particle by its share: x_k += w_k b_k / (sum of w b^2) shift.
inline void shift_contact(const ContactRow& row, const Vec3& shift, const float* inverse_mass, Vec3View x) {
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t i = row.particle[k];
    x.add(i, shift * (inverse_mass[i] * row.weight[k] / row.inverse_mass));
  }
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
