// The program `pleat`: runs scenes and shows them. All that it knows of the library is engine/pleat.h.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "demo/inform.h"
#include "demo/program/entry.h"
#include "demo/run.h"
#include "engine/pleat.h"

namespace {

using pleat::demo::kBadInput;
using pleat::demo::PictureSize;
using pleat::demo::RunOptions;

PictureSize parse_size(const std::string& text) {
  PictureSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) != 2 || size.width < 16 ||
      size.height < 16 || size.width > 8192 || size.height > 8192) {
    throw CLI::ValidationError("--size", "should be WIDTHxHEIGHT, each 16 to 8192, is `" + text + "`");
  }
  return size;
}

void add_run_options(CLI::App& run, RunOptions& options) {
  auto& scene = options.scene;
  run.add_option("scene", scene.scene, "a scene of `pleat list` or the path of a JSON file, :N sets its size")
      ->capture_default_str();
  run.add_option("--clip", scene.clip, "motion to play in place of the scene's, a BVH file")->type_name("FILE");
  run.add_option("--rate", scene.rate, "frames a second")->type_name("HZ")->check(CLI::Range(1.0, 10000.0));
  run.add_option("--frames", scene.frames, "how many frames")->type_name("N")->check(CLI::Range(1, 1000000));
  const auto setting = [&scene](const char* key) {
    return [&scene, key](const std::string& value) { scene.settings.push_back(std::string(key) + "=" + value); };
  };
  run.add_option_function<std::string>("--surface", setting("surface"),
                                       "flat, pn, paper, pleat (default), phong, spherigon or arc-pn");
  run.add_option_function<std::string>("--level", setting("level"), "triangles a face: fan (18) or n = 1..8 (4 n^2)");
  run.add_option("--set", scene.settings, "a setting of the cloth, see `pleat list`")->type_name("KEY=VALUE");
  run.add_option("--out", options.out, "folder for pictures")->type_name("DIR")->capture_default_str();
  run.add_option_function<std::string>(
         "--size", [&options](const std::string& text) { options.size = parse_size(text); }, "of a picture, pixels")
      ->type_name("WxH")
      ->default_str("1280x720");
  run.add_flag("!--no-render", options.render, "simulate only: no pictures");
  run.add_option("--json", options.json, "write a report for scripts")->type_name("FILE");
}

int run_program(int argc, char** argv, const pleat_api& api) {
  CLI::App app("Cloth of a few hundred particles, drawn as a curved surface.", "pleat");
  app.require_subcommand(1);
  RunOptions options;
  CLI::App* list = app.add_subcommand("list", "scenes, surfaces, integrators, settings, features");
  CLI::App* run = app.add_subcommand("run", "simulate a scene; write pictures, a film and a table of costs");
  CLI::App* explain = app.add_subcommand("explain", "which systems run for a scene, and which do not and why");
  add_run_options(*run, options);
  explain->add_option("scene", options.scene.scene, "as for run")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  if (*list) pleat::demo::list(api);
  if (*run) pleat::demo::run(api, options);
  if (*explain) pleat::demo::explain(api, options.scene);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return pleat::demo::run_main("pleat", [=] { return run_program(argc, argv, pleat::demo::library()); });
}
