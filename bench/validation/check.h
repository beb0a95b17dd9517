#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "engine/pleat.h"

namespace pleat::bench {

/// One figure against what it has to be. Two kinds for most cases: `discrete`, the same scheme in exact arithmetic,
/// tells whether the code is right; `continuum`, what nature or the differential equation says, tells whether the model
/// is.
struct Check {
  std::string name;
  double expected, measured;
  double error;  ///< relative or absolute: what the gate is for
  double gate;

  bool pass() const { return error <= gate; }  // false for NaN
};
using Checks = std::vector<Check>;

inline Check relative(std::string name, double expected, double measured, double gate) {
  return {std::move(name), expected, measured, std::abs(measured - expected) / std::abs(expected), gate};
}
inline Check absolute(std::string name, double expected, double measured, double gate) {
  return {std::move(name), expected, measured, std::abs(measured - expected), gate};
}

struct Case {
  const char* name;
  const char* about;
  bool quick;  ///< done within a fraction of a second: part of the tests
  Checks (*run)(const pleat_api&);
};

extern const std::span<const Case> kCases;

// particle_cases.cpp
Checks free_fall(const pleat_api&);
Checks oscillator(const pleat_api&);
Checks order(const pleat_api&);
Checks pendulum(const pleat_api&);
Checks energy(const pleat_api&);
// chain_cases.cpp
Checks chain_swing(const pleat_api&);
Checks catenary(const pleat_api&);
Checks own_weight(const pleat_api&);
// bending_cases.cpp
Checks cantilever(const pleat_api&);
Checks fabrics(const pleat_api&);
// outside_cases.cpp
Checks terminal_velocity(const pleat_api&);
Checks incline(const pleat_api&);
Checks momentum(const pleat_api&);

}  // namespace pleat::bench
