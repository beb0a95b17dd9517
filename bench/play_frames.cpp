// The program `play_frames`: the frames of a scene as a host plays them and nothing else, for tools that count or
// sample what they cost (instructions.sh).
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/program/progress.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"
#include "demo/scenes/scene_reader.h"

namespace {

namespace demo = pleat::demo;

int run_program(int argc, char** argv) {
  CLI::App app("Plays the frames of a scene. Prints what it was built by, and how.", "play_frames");
  demo::SceneRequest request;
  request.scene = "skirt_kick";
  app.add_option("--scene", request.scene, "a scene of `pleat list` or the path of a JSON file")->capture_default_str();
  app.add_option("--rate", request.rate, "frames a second")->type_name("HZ")->check(pleat::demo::between(1.0, 10000.0));
  app.add_option("--frames", request.frames, "how many frames")->type_name("N")->check(CLI::Range(1, 1000000));
  app.add_option("--set", request.settings, "a setting of the cloths, see `pleat list`; may be repeated")
      ->type_name("KEY=VALUE");
  bool explain = false;
  app.add_flag("--explain", explain, "print which systems run, and why others do not");
  if (const auto status = demo::parse(app, argc, argv)) return *status;
  const pleat_api& api = demo::library();
  demo::Scene scene(api, demo::load_scene(api, request));
  if (explain)
    scene.check(api.world_explain(
                    scene.world(), [](const char* line, void*) { std::puts(line); }, nullptr),
                "plan");
  std::vector<demo::DrawnSurface> surfaces;
  for (size_t k = 0; k < scene.cloths().size(); ++k) surfaces.push_back(demo::make_surface(scene, k));
  {
    demo::Progress progress("playing, frame", scene.def().frames);
    for (uint32_t frame = 0; frame < scene.def().frames; ++frame) {
      scene.advance();
      for (size_t k = 0; k < surfaces.size(); ++k) demo::read_vertices(scene, k, surfaces[k]);
      progress.step();
    }
  }
  const nlohmann::ordered_json machine = pleat::bench::describe_machine(api);
  std::printf("compiler %s\nflags %s\n", machine["compiler"].get<std::string>().c_str(),
              machine["flags"].get<std::string>().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return demo::run_main("play_frames", [=] { return run_program(argc, argv); });
}
