// Friction inside the cloth: threads that rub on each other end small swings, which no viscous damping does in time,
// and hold a fold where it came to rest.
//   S. Kawabata, "The Standardization and Analysis of Hand Evaluation", 1980: the hysteresis of bending and shear.
//   C. Canudas de Wit, H. Olsson, K. Astrom, P. Lischinsky, "A New Model for Control of Systems with Friction", 1995:
//   what sticks gives way like a spring, and holds more than what slips (Stribeck).
#pragma once

#include "components/garment.h"
#include "components/wide.h"

namespace pleat {

/// Coulomb's law for a whole cloth: a deceleration a against motion relative to what carries the cloth, as strong for
/// slow motion as for fast, and up to 2 a for what has stopped. The carrier moves with the mean velocity u of the pins
/// or, where there are none, of the whole cloth, whose momentum then stays what it is: a cloth that falls, flies or is
/// worn is not held back. With r = v - u, w = 1 / (4 dt) and the limit g = a (1 + 1 / (1 + (|r| / 1 mm/s)^2)):
///   s += w^2 r dt,  |s| <= g;     F -= m (s + 2 w r),  at most m g
/// A swing of angular frequency W loses 4 a / W^2 of its amplitude a period and then stops, and the spring s holds it
/// there: it is critically damped and gives way by a / w^2, some micrometres. Friction that merely faded with speed
/// would let folds creep, and slip long after the body has stopped.
/// Reads:  mass (P) kg; velocity (P) m/s
/// Writes: held (P) m/s2: s; force (P) N, added to
/// Cost:   O(P), no allocation. Errors: none.
struct InnerFriction {
  const Garment* garment = nullptr;
  const float* mass = nullptr;
  ConstVec3View velocity;
  float deceleration = 0.0f;  // a, m/s2
  float dt = 0.0f;            // s
  float elapsed = 0.0f;       // s, since the last call: dt, or its share where a step has several stages
  Vec3View held, force;

  bool validate() const;
  void run(VectorSet set = widest_vectors()) const;
};

}  // namespace pleat
