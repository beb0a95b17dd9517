#pragma once

#include <functional>

#include "engine/pleat.h"

namespace pleat::demo {

inline constexpr int kBadInput = 2, kOwnFailure = 1;  ///< exit statuses; 0 is success

/// The library's functions. Throws std::runtime_error when it does not speak our version.
const pleat_api& library();

/// What every `main` does: runs `body`, whose result is the exit status. What it throws goes to stderr behind the
/// program's name: InputError makes the status kBadInput, any other exception and a stdout that cannot be written
/// kOwnFailure. Ctrl-C is caught, see catch_interrupt.
int run_main(const char* program, const std::function<int()>& body);

}  // namespace pleat::demo
