// The program `ablation`: what each part that a scene may do without costs there, and what is lost without it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/ablation/worth.h"
#include "bench/machine.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/program/progress.h"
#include "demo/scenes/scene_reader.h"

namespace {

namespace demo = pleat::demo;
using namespace pleat::bench;

const std::vector<std::string> kScenes = {"skirt_kick", "hanging_square:16", "drape_sphere:16", "clothesline:17"};
const std::vector<std::string> kQuickScenes = {"skirt_kick", "hanging_square:8", "drape_sphere:8", "clothesline:7"};

int run_program(int argc, char** argv) {
  CLI::App app(
      "What each part that a scene may do without costs there, and what is lost without it. A part that the scene "
      "does\n"
      "not have is put in first, and marked +. Saved: us a frame. Then what is added where the part is left out: the\n"
      "largest stretch of an edge; the deepest point inside a body; drawn edges against their rest length, RMS;\n"
      "crossings of the cloth with itself a frame; motion at rest (not with --quick). Last, how far what is drawn in\n"
      "the last frame is from the same with the part, RMS, and how far its normals are turned.",
      "ablation");
  bool quick = false;
  uint32_t rounds = 7;
  std::vector<std::string> names;
  app.add_flag("--quick", quick, "100 frames of smaller scenes, two rounds, without what comes after them");
  app.add_option("--scene", names, "only this one, of `pleat list` or the path of a JSON file; may be repeated")
      ->type_name("NAME");
  auto* rounds_option =
      app.add_option("--rounds", rounds, "in which all variants are timed in turn")->check(CLI::Range(1, 1000));
  rounds_option->capture_default_str();
  demo::OutputOption json(app, "--json", "write the figures for scripts");
  if (const auto status = demo::parse(app, argc, argv)) return *status;
  if (quick && rounds_option->empty()) rounds = 2;
  if (names.empty()) names = quick ? kQuickScenes : kScenes;

  const pleat_api& api = demo::library();
  std::vector<demo::SceneDef> scenes;
  for (const std::string& name : names) {
    demo::SceneRequest request;
    request.scene = name;
    if (quick) request.frames = 100;
    scenes.push_back(demo::load_scene(api, request));
  }
  json.open();
  std::vector<SceneWorth> worths;
  {
    demo::Progress progress("leaving out, round or part", uint32_t(scenes.size()) * worth_steps(rounds));
    for (const demo::SceneDef& scene : scenes) {
      worths.push_back(measure_worth(api, scene, rounds, !quick, [&] { progress.step(); }));
    }
  }
  auto figures = nlohmann::ordered_json::array();
  for (const SceneWorth& worth : worths) {
    if (&worth != &worths.front()) std::printf("\n");
    print_worth(worth);
    figures.push_back(worth_json(worth));
  }
  json.commit(nlohmann::ordered_json{{"scenes", figures}, {"machine", describe_machine(api)}});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return demo::run_main("ablation", [=] { return run_program(argc, argv); });
}
