// Friction inside the cloth: threads that rub on each other end small swings, which no viscous damping does in time.
//   S. Kawabata, "The Standardization and Analysis of Hand Evaluation", 1980: the hysteresis of bending and shear.
#pragma once

#include "components/garment.h"

namespace pleat {

/// Coulomb's law for a whole cloth: a deceleration a against motion relative to what carries the cloth, as strong for
/// slow motion as for fast. The carrier moves with the mean velocity u of the pins or, where there are none, of the
/// whole cloth, whose momentum then stays what it is: a cloth that falls, flies or is worn is not held back.
///   F_i -= m_i min(a / |v_i - u|, 0.5 / dt) (v_i - u)
/// A swing of angular frequency w loses 4 a / w^2 of its amplitude a period and then stops. The rate is held below
/// 0.5 / dt, so that no step turns the motion around.
/// Reads:  mass (P) kg; velocity (P) m/s.  Writes: force (P) N, added to.  Cost: O(P).  Errors: none.
struct InnerFriction {
  const Garment* garment = nullptr;
  const float* mass = nullptr;
  ConstVec3View velocity;
  float deceleration = 0.0f;  // a, m/s2
  float dt = 0.0f;            // s
  Vec3View force;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
