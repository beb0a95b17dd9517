#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/pleat.h"

namespace pleat::bench {

/// What a figure was measured on: processor, compiler, flags, commit, and the library's features.
nlohmann::ordered_json describe_machine(const pleat_api& api);

}  // namespace pleat::bench
