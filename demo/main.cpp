// The program `pleat`: runs scenes and shows them. All that it knows of the library is engine/pleat.h.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "demo/compare.h"
#include "demo/inform.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/run.h"
#include "engine/pleat.h"

namespace {

using pleat::demo::CompareOptions;
using pleat::demo::kBadInput;
using pleat::demo::PictureSize;
using pleat::demo::RunOptions;
using pleat::demo::SceneRequest;

PictureSize parse_size(const std::string& text) {
  PictureSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) != 2 || size.width < 16 ||
      size.height < 16 || size.width > 8192 || size.height > 8192) {
    throw CLI::ValidationError("--size", "should be WIDTHxHEIGHT, each 16 to 8192, is `" + text + "`");
  }
  return size;
}

void add_scene_options(CLI::App& run, SceneRequest& scene) {
  run.add_option("scene", scene.scene, "a scene of `pleat list` or the path of a JSON file, :N sets its size")
      ->capture_default_str();
  run.add_option("--clip", scene.clip, "motion to play in place of the scene's, a BVH file")
      ->type_name("FILE")
      ->check(pleat::demo::named());
  run.add_option("--rate", scene.rate, "frames a second")->type_name("HZ")->check(pleat::demo::between(1.0, 10000.0));
  run.add_option("--set", scene.settings, "a setting of the cloth, see `pleat list`")->type_name("KEY=VALUE");
}

void add_size_option(CLI::App& run, PictureSize& size, const std::string& shown) {
  run.add_option_function<std::string>(
         "--size", [&size](const std::string& text) { size = parse_size(text); }, "of a picture, pixels")
      ->type_name("WxH")
      ->default_str(shown);
}

void add_run_options(CLI::App& run, RunOptions& options) {
  auto& scene = options.scene;
  add_scene_options(run, scene);
  run.add_option("--frames", scene.frames, "how many frames")->type_name("N")->check(CLI::Range(1, 1000000));
  const auto setting = [&scene](const char* key) {
    return [&scene, key](const std::string& value) { scene.settings.push_back(std::string(key) + "=" + value); };
  };
  run.add_option_function<std::string>("--surface", setting("surface"),
                                       "flat, pn, paper, pleat (default), phong, spherigon or arc-pn");
  run.add_option_function<std::string>("--level", setting("level"), "triangles a face: fan (18) or n = 1..8 (4 n^2)");
  run.add_option("--out", options.out, "folder for pictures")
      ->type_name("DIR")
      ->check(pleat::demo::named())
      ->capture_default_str();
  add_size_option(run, options.size, "1280x720");
  run.add_flag("!--no-render", options.render, "simulate only: no pictures");
  run.add_option("--json", options.json, "write a report for scripts")->type_name("FILE")->check(pleat::demo::named());
}

void add_compare_options(CLI::App& compare, CompareOptions& options) {
  add_scene_options(compare, options.scene);
  compare.add_option("--row", options.rows, "settings of a row of pictures, joined by commas; once for each row")
      ->type_name("KEY=VALUE")
      ->required();
  compare.add_option("--first", options.first, "first frame shown")->check(CLI::Range(1, 1000000));
  compare.add_option("--every", options.every, "frames from one picture to the next")->check(CLI::Range(1, 10000));
  compare.add_option("--columns", options.columns, "pictures a row")->check(CLI::Range(1, 100));
  compare.add_flag("--close-up", options.close_up, "one picture a row: close to where the first two rows differ most");
  add_size_option(compare, options.size, "640x640");
  compare.add_option("--out", options.out, "the picture")
      ->type_name("FILE")
      ->check(pleat::demo::named())
      ->capture_default_str();
}

int run_program(int argc, char** argv, const pleat_api& api) {
  CLI::App app("Cloth of a few hundred particles, drawn as a curved surface.", "pleat");
  app.require_subcommand(0, 1);  // none is told below: CLI11 would tell of it where one is unknown
  app.set_version_flag("--version", std::string("pleat ") + api.version);
  RunOptions options;
  CLI::App* list = app.add_subcommand("list", "scenes, surfaces, integrators, settings, features");
  CLI::App* run = app.add_subcommand("run", "simulate a scene; write pictures, a film and a table of costs");
  CLI::App* compare = app.add_subcommand("compare", "one picture of a scene under different settings");
  CLI::App* explain = app.add_subcommand("explain", "which systems run for a scene, and which do not and why");
  add_run_options(*run, options);
  CompareOptions comparison;
  add_compare_options(*compare, comparison);
  explain->add_option("scene", options.scene.scene, "as for run")->capture_default_str();
  if (const auto status = pleat::demo::parse(app, argc, argv)) return *status;
  if (app.get_subcommands().empty()) {
    std::fputs("pleat: a command is missing: list, run, compare or explain; --help says more\n", stderr);
    return kBadInput;
  }
  if (*list) pleat::demo::list(api);
  if (*run) pleat::demo::run(api, options);
  if (*compare) pleat::demo::compare(api, comparison);
  if (*explain) pleat::demo::explain(api, options.scene);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return pleat::demo::run_main("pleat", [=] { return run_program(argc, argv, pleat::demo::library()); });
}
