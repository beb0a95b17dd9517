// Counts what this program takes from the heap.
#pragma once

#include <cstdint>
#include <optional>

namespace pleat {

/// Calls of the global operator new.
std::uint64_t global_allocations();
/// Calls of malloc, calloc and realloc, of which Eigen makes some; none where they cannot be counted.
std::optional<std::uint64_t> heap_calls();

}  // namespace pleat
