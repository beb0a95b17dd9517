// How fast a cloth can vibrate, for each unit of its parameters.
#pragma once

namespace pleat {

/// omega^2 <= k stretch + B bend,   c <= edge_rate edge_damping + bend_rate bend_damping
/// for the largest angular frequency omega, 1/s, and the largest rate of damping c, 1/s, of any motion of the cloth.
struct FrequencyRates {
  float stretch = 0.0f;  // 1/kg
  float bend = 0.0f;     // 1/(kg m2)
  float edge_damping = 0.0f, bend_damping = 0.0f;
};

}  // namespace pleat
