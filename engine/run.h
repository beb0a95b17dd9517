// How the engine runs a system.
#pragma once

#include <cassert>
#include <utility>

namespace pleat {

/// What it returns; the arguments are those of its run().
template <class System, class... Arguments>
auto run(const System& system, Arguments&&... arguments) {
  assert(system.validate());
  return system.run(std::forward<Arguments>(arguments)...);
}

}  // namespace pleat
