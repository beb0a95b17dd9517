#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/budget.h"

namespace pleat::bench {

void print_budget(const demo::SceneDef& def, const Budget& budget);

nlohmann::ordered_json budget_json(const pleat_api& api, const demo::SceneDef& def, const Budget& budget);

}  // namespace pleat::bench
