#pragma once

#include <cstdint>

namespace pleat::bench {

/// Calls of any form of operator new in this program so far, the library's included.
uint64_t allocation_count();

}  // namespace pleat::bench
