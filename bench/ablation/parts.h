#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "demo/scenes/scene_def.h"

namespace pleat::bench {

/// Something that the settings can leave out of a cloth.
struct Part {
  std::string_view name;
  std::vector<std::string> without;  ///< the settings that leave it out, `key=value`
  std::vector<std::string> with;     ///< for scenes that do not have it, put it in; empty: every scene has it
};

/// In the order of the schedule, as far as it goes. The first is none: a thousandth of the air's damping, which shows
/// what chance does to the figures of the others.
std::span<const Part> parts();

/// A scene with a part and without it; one of the two is the scene as it is.
struct Ablation {
  const Part* part;
  pleat_cloth_settings with, without;
  bool put_in;  ///< the scene does not have the part
};

/// Throws InputError where a part names a setting that there is not.
Ablation ablate(const demo::SceneDef& scene, const Part& part);

}  // namespace pleat::bench
