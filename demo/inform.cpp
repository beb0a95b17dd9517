#include "demo/inform.h"

#include <cstdio>

#include "demo/scenes/scene.h"
#include "demo/scenes/scene_files.h"
#include "demo/scenes/settings.h"

namespace pleat::demo {
namespace {

template <typename Named>
void print_names(const char* title, std::span<const Named> list) {
  std::printf("%-12s", title);
  for (const Named& named : list) std::printf(" %s", std::string(named.name).c_str());
  std::printf("\n");
}

}  // namespace

void list(const pleat_api& api) {
  std::printf("scenes (a path of a JSON file is one too; :N sets a size)\n");
  for (const std::string& name : shipped_scenes()) {
    std::printf("  %-20s %s\n", name.c_str(), scene_description(name).c_str());
  }
  print_names("surfaces", kSurfaces);
  print_names("levels", kLevels);
  print_names("integrators", kIntegrators);
  print_names("settings", kSettings);
  std::printf("%-12s%s%s\n", "features", api.features & PLEAT_FEATURE_COLLISION ? " collision" : "",
              api.features & PLEAT_FEATURE_SMOOTHING ? " smoothing" : "");
  std::printf("%-12s %s\n", "version", api.version);
}

void explain(const pleat_api& api, const SceneRequest& request) {
  SceneDef def = load_scene(api, request);
  def.settle = 0.0;
  const Scene scene(api, std::move(def));
  scene.check(api.world_explain(
                  scene.world(), [](const char* line, void*) { std::puts(line); }, nullptr),
              "explain");
}

}  // namespace pleat::demo
