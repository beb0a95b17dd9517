// Tells pins that have jumped (the character was placed elsewhere) from pins that move fast.
#pragma once

#include <cstddef>
#include <optional>

#include "components/column.h"
#include "components/rigid_pose.h"

namespace pleat {

/// The rigid motion that brings the pins nearest to where they shall be at the end of the tick, if it is a jump:
///  - their mean speed v = d / dt and its change since the last tick are both above `speed`. What merely goes fast, a
///    train or a fall, does not change by as much in a tick, and what stands still after a jump has no speed; or
///  - they turn by more than 150 degrees. On the straight ways that pins take, they would meet half way.
/// Reads:  previous, next (pins) m.  Cost: O(pins), a few us in a tick with a jump.  Errors: none.
struct PinJump {
  std::size_t count = 0;
  ConstVec3View previous, next;
  float speed = 0.0f;              // m/s
  Vec3 velocity, velocity_before;  // m/s, mean of the pins in this tick and in the last

  bool validate() const;
  std::optional<RigidMotion> run() const;
};

/// How far so many points move on average, m.
Vec3 mean_motion(ConstVec3View previous, ConstVec3View next, std::size_t count);

}  // namespace pleat
