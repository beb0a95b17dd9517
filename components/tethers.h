// How far a garment lets its particles come from its pins.
//   T.-Y. Kim, N. Chentanez, M. Mueller, "Long Range Attachments: A Method to Simulate Inextensible Clothing in
//   Computer Games", 2012.
#pragma once

#include <cstdint>

namespace pleat {

struct Garment;

/// As many edges away from a pin a pull arrives with the default number of sweeps.
inline constexpr std::uint32_t kSweepReach = 8;

/// Fills the garment's depth and, where that is kSweepReach or more, its tethers. The garment has its edges, hinges and
/// pins. A tether is as long as the shortest way over the rest surface (geodesics.h): farther away no cloth comes that
/// does not stretch in any direction. Ways along the edges alone are up to two fifths longer, across the diagonals of
/// squares, and a heavy hem then stretches the cloth by that much.
/// Cost: O(E log E). Throws std::bad_alloc.
void measure_tethers(Garment& garment);

}  // namespace pleat
