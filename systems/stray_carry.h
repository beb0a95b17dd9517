// Vertices that no triangle uses: no part of the cloth, but where the cloth is.
#pragma once

#include "components/garment.h"

namespace pleat {

/// Puts each stray vertex of the garment onto the particle that carries them all, so that boxes, mean velocities and
/// relative motion of a cloth are those of its triangles, and gives it that particle's velocity, with which it drifts
/// until it is put back.
/// Reads:  garment strays, stray_on.  Writes: position m, velocity m/s of the strays.
/// Cost:   O(strays), no allocation.  Errors: none.
struct StrayCarry {
  const Garment* garment = nullptr;
  Vec3View position, velocity;

  bool validate() const { return garment != nullptr && position.x != nullptr && velocity.x != nullptr; }
  void run() const {
    const Vec3 x = position[garment->stray_on], v = velocity[garment->stray_on];
    for (const std::uint32_t i : garment->strays) {
      position.set(i, x);
      velocity.set(i, v);
    }
  }
};

}  // namespace pleat
