// Whether a cloth moves as if it had exploded: faster than all that acted on it in a tick could have made it.
#pragma once

#include "components/colliders.h"
#include "components/garment.h"

namespace pleat {

/// Root mean square speed of the free particles, weighted by mass, m/s: the square root of twice their kinetic energy
/// over their mass; 0 where all are pinned. Not finite where one of them is not. Cost: O(P).
float rms_speed(std::size_t count, const float* mass, const float* inverse_mass, const ConstVec3View& velocity);

/// The speed that a cloth may have when a tick ends: twice the sum of what each source alone could give it, plus 10 m/s
/// for what is not listed,
///   2 (v + |g| dt + wind + fastest pin + fastest body + c + e) + 10 m/s
/// v its own when the tick began; c = (by how much the longest edge or tether exceeds its rest length) / substep, which
/// the strain limit turns into motion; e = sqrt(2 E / mass) of the energy E in springs, about k d^2 max(1, d/L) / 2 for
/// d = l - L, and in bending through half a turn. An explosion goes past any such bound within a few substeps.
/// Reads:  garment; start (P) m, where the tick began; mass kg, inverse_mass 1/kg (P); pins (pins) m; bodies
/// Cost:   O(P + E + bodies' vertices), no allocation: for ticks that look suspicious.  Errors: none.
struct SpeedBound {
  const Garment* garment = nullptr;
  ConstVec3View start;
  const float* mass = nullptr;
  const float* inverse_mass = nullptr;
  ConstVec3View pin_previous, pin_next;
  BodiesMet bodies;
  float start_speed = 0.0f;                       // v, m/s
  float gravity = 0.0f, wind = 0.0f;              // m/s2, m/s
  float stiffness = 0.0f, bend_stiffness = 0.0f;  // N/m, N m
  float room = 0.0f;                              // 1/s2, as in ElasticForce: what is stiffer acts softer
  float dt = 0.0f, substep = 0.0f;                // s

  /// What can be said without looking: enough for a cloth in calm motion. m/s
  float least() const;
  bool validate() const;
  float run() const;
};

}  // namespace pleat
