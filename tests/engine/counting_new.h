// Counts every call of the global operator new in this program.
#pragma once

#include <cstdint>

namespace pleat {

std::uint64_t global_allocations();

}  // namespace pleat
