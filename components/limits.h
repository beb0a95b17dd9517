// What a cloth's state stays within: the border takes no more, and a tick that leaves it has gone wrong.
#pragma once

namespace pleat {

/// On each axis. Beyond it single precision no longer tells millimetres apart by far.
inline constexpr float kFarthest = 1e6f;  // m
/// On each axis, of a particle.
inline constexpr float kFastest = 1e5f;  // m/s

}  // namespace pleat
