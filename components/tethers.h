// How far apart the edges of a garment let its particles come.
//   T.-Y. Kim, N. Chentanez, M. Mueller, "Long Range Attachments: A Method to Simulate Inextensible Clothing in
//   Computer Games", 2012.
#pragma once

#include <cstdint>

namespace pleat {

struct Garment;

/// As many edges away from a pin a pull arrives with the default number of sweeps.
inline constexpr std::uint32_t kSweepReach = 8;

/// Fills the garment's depth and, where that is kSweepReach or more, its tethers. The garment has its edges and pins.
/// A tether is as long as the shortest way along the edges, so it asks for nothing that the edges do not ask for.
/// Cost: O(E log E). Throws std::bad_alloc.
void measure_tethers(Garment& garment);

}  // namespace pleat
