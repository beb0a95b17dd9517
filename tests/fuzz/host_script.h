// A host that does what bytes say: any calls of the C interface, in any order, with any arguments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/pleat.h"

namespace pleat::fuzz {

/// What a host has seen of the library.
struct Seen {
  std::string fault;  ///< the first number that came out not finite, and of what; empty: none
  std::uint64_t accepted = 0, refused = 0;
  pleat_stats stats{};  ///< of the world in the end
};

/// Makes a world, plays `bytes` as calls until they end, and looks at every particle and every drawn vertex after each.
/// The calls refuse or do what they are asked; sanitizers see to the rest.
Seen play(const std::uint8_t* bytes, std::size_t count);

}  // namespace pleat::fuzz
