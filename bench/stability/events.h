// Things that happen to cloth in games and should not: what `stability_map --events` goes through.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/stability/event_stage.h"
#include "demo/scenes/scene_def.h"
#include "engine/pleat.h"

namespace pleat::bench {

struct Event {
  std::string name;
  std::function<void(RigDef&)> prepare;     ///< changes the cloth before it is made, or null
  std::function<void(EventStage&)> happen;  ///< or null
};

/// All of them; a cloth at rest is watched for `rest_ticks`, 0 leaves that out.
std::vector<Event> events(long rest_ticks);

/// Lets it happen to `scene` (its garment and pins), and looks on for four seconds more. Strain above 10 % then, a
/// number that is not finite, or bad input that is let in, make the outcome `failed`; so does an unexpected refusal.
EventResult run_event(const pleat_api& api, const demo::SceneDef& scene, const Event& event);

nlohmann::ordered_json events_json(std::span<const EventResult> results);
void print_events(std::span<const EventResult> results);

}  // namespace pleat::bench
