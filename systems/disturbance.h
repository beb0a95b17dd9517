// Whether anything around a cloth that sleeps has moved.
#pragma once

#include "components/colliders.h"
#include "components/garment.h"

namespace pleat {

/// Says whether a pin moves in this tick, or a body that the cloth meets and that moves comes within `reach` of it: on
/// its way or, where it jumps, as it leaves or arrives.
///
/// Reads:  position (P) m; pin_previous, pin_next (pins) m; bodies
/// Cost:   O(P + capsules), and O(vertices) of each mesh that may have moved; no allocation. Errors: none.
struct Disturbance {
  const Garment* garment = nullptr;
  ConstVec3View position;
  Vec3 origin{};  // of positions, m in the world
  ConstVec3View pin_previous, pin_next;
  BodiesMet bodies;
  float reach = 0.0f;      // m
  bool on_the_way = true;  // else bodies jump

  bool validate() const;
  bool run() const;
};

/// The largest speed of any particle, m/s. Cost: O(P).
float largest_speed(std::size_t count, const ConstVec3View& velocity);

}  // namespace pleat
