// Shortest ways over the rest surface.
//   R. Kimmel, J. Sethian, "Computing Geodesic Paths on Manifolds", 1998: one pass, nearest particle first.
//   M. Novotni, R. Klein, "Computing Geodesic Distances on Triangular Meshes", 2002: the source, unfolded into the
//   plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pleat {

struct Garment;

inline constexpr std::size_t kPinsPerParticle = 2;

struct Way {
  float length;  // m
  std::uint32_t particle, pin;
};

/// The ways from each particle that is no pin to its nearest kPinsPerParticle pins, shortest first. They go along
/// edges and straight across faces; where the rest surface is flat they are exact, elsewhere within about a hundredth.
/// The garment has its edges, hinges and pins. Cost: O(E log E). Throws std::bad_alloc.
std::vector<Way> ways_to_pins(const Garment& garment);

}  // namespace pleat
