// The moving state of all cloths' particles, one flat column per quantity; a cloth owns a range of them.
#pragma once

#include <array>

#include "components/column.h"

namespace pleat {

struct ParticleColumns {
  Vec3Column position;         // m
  Vec3Column velocity;         // m/s
  Vec3Column force;            // N, summed anew for each evaluation
  Vec3Column previous;         // m, position when the substep began
  Vec3Column predicted;        // m, position right after integration, before any constraint moved it
  Vec3Column start;            // m, position when the tick began
  Vec3Column start_velocity;   // m/s, the same of the velocity
  Column<float> inverse_mass;  // 1/kg, 0 for pinned and padding particles
  Column<float> mass;          // kg, the true one for pinned particles too

  explicit ParticleColumns(std::pmr::memory_resource* m)
      : position(m),
        velocity(m),
        force(m),
        previous(m),
        predicted(m),
        start(m),
        start_velocity(m),
        inverse_mass(m),
        mass(m) {}
  std::array<Vec3Column*, 7> vectors() {
    return {&position, &velocity, &force, &previous, &predicted, &start, &start_velocity};
  }
};

/// Only where a cloth integrates by Runge-Kutta: the weighted sum of its four slopes.
struct RungeKuttaColumns {
  Vec3Column start_velocity, position_slope, velocity_slope;

  explicit RungeKuttaColumns(std::pmr::memory_resource* m) : start_velocity(m), position_slope(m), velocity_slope(m) {}
};

}  // namespace pleat
