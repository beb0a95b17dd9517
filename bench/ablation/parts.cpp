#include "bench/ablation/parts.h"

#include "demo/scenes/settings.h"

namespace pleat::bench {
namespace {

pleat_cloth_settings changed(pleat_cloth_settings settings, std::span<const std::string> assignments) {
  for (const std::string& assignment : assignments) demo::apply_option(assignment, settings);
  return settings;
}

bool same(const pleat_cloth_settings& a, const pleat_cloth_settings& b) {
  for (const demo::Setting& setting : demo::kSettings) {
    if (!std::visit([&](auto field) { return a.*field == b.*field; }, setting.field)) return false;
  }
  return true;
}

}  // namespace

std::span<const Part> parts() {
  static const std::vector<Part> kParts = {{"nothing: chance", {"air_damping=0.1001"}, {}},
                                           {"bending", {"bend_stiffness=0", "bend_damping=0"}, {}},
                                           {"edge damping", {"edge_damping=0"}, {}},
                                           {"air damping", {"air_damping=0"}, {}},
                                           {"inner friction", {"inner_friction=0"}, {}},
                                           {"drag of the air", {"drag_coefficient=0"}, {"drag_coefficient=1"}},
                                           {"buckling", {"buckling_strain=1"}, {}},
                                           {"self-contact", {"self_distance=0"}, {"self_distance=0.005"}},
                                           {"strain limit, tethers", {"stretch_limit=1"}, {}},
                                           {"friction", {"friction=0"}, {}},
                                           {"teleports found", {"teleport_speed=0"}, {}},
                                           {"sleep", {"sleep_speed=0"}, {"sleep_speed=0.001"}},
                                           {"curved surface", {"surface=flat"}, {}},
                                           {"normal and edge control", {"surface=pn"}, {}},
                                           {"our rules, not the paper's", {"surface=paper"}, {}},
                                           {"fold relaxation", {"fold_sweeps=0"}, {"fold_sweeps=8"}},
                                           {"tangents", {"tangents=0"}, {"tangents=1"}}};
  return kParts;
}

Ablation ablate(const demo::SceneDef& scene, const Part& part) {
  const pleat_cloth_settings without = changed(scene.settings, part.without);
  if (!same(without, scene.settings)) return {&part, scene.settings, without, false};
  return {&part, changed(scene.settings, part.with), without, true};
}

}  // namespace pleat::bench
