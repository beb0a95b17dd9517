// Contact rows: one inequality each,  n . (b0 x0 + b1 x1 + b2 x2) >= d,  for a point of the cloth with barycentrics b
// on three of its particles. A contact at a particle has b = (1, 0, 0); on an edge one weight is zero.
#pragma once

#include <cstdint>

#include "components/vec3.h"

namespace pleat {

struct ContactRow {
  std::uint32_t particle[3];  // cloth-local; all three valid even where the weight is zero
  float weight[3];            // barycentrics, sum 1
  Vec3 normal;                // out of the body, unit
  float offset;               // d, m
  Vec3 body_step;             // motion of the touched point of the body over the substep, m
  float friction;             // Coulomb coefficient of the pair
  float inverse_mass;         // sum of w_i b_i^2, 1/kg: how much the point yields to an impulse
  float push;                 // m, total distance pushed in this substep's sweeps
  bool at_particle;           // a particle row, as against one on an edge or a face
};

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
