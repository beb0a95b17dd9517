#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "demo/measure.h"

namespace pleat::demo {

/// The table of a run: sizes, cost of each stage, quality, what the engine had to do.
void print_report(const SceneDef& def, const RunRecord& record);

/// The same for scripts; `files` is where pictures went.
nlohmann::ordered_json report_json(const SceneDef& def, const RunRecord& record,
                                   const std::vector<std::filesystem::path>& files);

}  // namespace pleat::demo
