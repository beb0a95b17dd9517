// Makes velocities agree with what the constraints did to positions.
#pragma once

#include <cstddef>

#include "components/column.h"

namespace pleat {

/// v_i += (x_i - predicted_i) / dt. Without it the motion that a constraint took away would come back at the next step,
/// and a hanging cloth would carry the velocity of free fall (the paper alters positions only; README says why not).
/// Reads:  position, predicted (P) m; inverse_mass (P).  Writes: velocity (P) m/s; columns with their padding.
/// Cost:   O(P).  Errors: none.
struct VelocityUpdate {
  std::size_t particle_count = 0;
  ConstVec3View position, predicted;
  const float* inverse_mass = nullptr;
  float dt = 0.0f;  // s
  Vec3View velocity;

  bool validate() const;
  void run() const;
};

}  // namespace pleat
