// What the machine can do at most, to hold the systems against.
#pragma once

namespace pleat::bench {

/// Registers `ceiling/...`: multiplications and additions in registers, items being flop; and a = b + s c over arrays
/// that fit into a cache, or into none.
void register_ceilings();

}  // namespace pleat::bench
