// A particle in contact is not accelerated into the body.
//   M. Oshita, A. Makinouchi, 2001, section 4.4.
#pragma once

#include "components/contacts.h"

namespace pleat {

/// Where a particle rests on a row of the previous substep and does not leave it, the part N of its force into the body
/// is taken out. The positions then need no push, and with the push Coulomb friction would be lost; so it is done here,
/// on the force: up to mu N against the sliding velocity that the particle would have at the end of the step.
/// Reads:  contacts of the previous substep; position m, velocity m/s (P); inverse_mass (P) 1/kg
/// Writes: force (P) N
/// Cost:   O(rows), no allocation. Errors: none.
struct ContactAcceleration {
  ContactList contacts;
  ConstVec3View position, velocity;
  const float* inverse_mass = nullptr;
  float dt = 0.0f;      // s, of the step that the force acts in
  float row_dt = 0.0f;  // s, of the substep that the rows are of
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
