// The discrete reference: springs after the paper's eq (1), stepped in double precision. A right program gives the same
// but for the rounding of its single precision.
#pragma once

#include <array>
#include <vector>

#include "bench/validation/rig.h"

namespace pleat::bench {

struct Spring {
  uint32_t i, j;
  double length;  ///< at rest, m
};

struct SpringNet {
  std::vector<Point> position, velocity;  ///< m, m/s
  std::vector<double> mass;               ///< kg; 0: pinned
  std::vector<Spring> springs;
  double stiffness = 0.0;  ///< k of eq (1), N/m
  double gravity = 0.0;    ///< m/s2, down

  /// One step of a PLEAT_INTEGRATOR_*.
  void step(double dt, uint32_t integrator);
  /// Kinetic and elastic energy, and that of height, J. A spring's is k (l^3/(3L) - l^2/2 + L^2/6).
  double energy() const;

 private:
  std::vector<Point> acceleration(const std::vector<Point>& x) const;
};

/// A triangle whose corners weigh density * area / 3 each, at rest in its present shape.
SpringNet net_of_triangle(const demo::TriangleMesh& mesh, const std::vector<uint32_t>& pins, double density,
                          double stiffness);

}  // namespace pleat::bench
