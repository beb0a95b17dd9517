#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "demo/quality/quality.h"
#include "demo/scenes/scene_def.h"

namespace pleat::bench {

/// A scene's quality from one start; number 0 is the scene as it is.
struct Start {
  uint32_t number;
  demo::Quality quality;
  /// Largest motion of a free particle in a frame, in 5 s from 6 s after the body came to rest: a fold that still
  /// slides. Absent where no body moves.
  std::optional<double> late_slip_mm;
};

/// Runs the scene from so many starts. In each but the first every free particle is moved by up to 1 mm along each
/// axis, by noise of the start's number. Throws as Scene.
std::vector<Start> measure_starts(const pleat_api& api, const demo::SceneDef& def, uint32_t count);

/// {"runs": [{"start", figures}], "worst": figures}
nlohmann::ordered_json starts_json(const std::vector<Start>& starts);

void print_starts(const std::vector<Start>& starts);

}  // namespace pleat::bench
