// The program `surface_error`: how far the drawn surface is from the truth, mode by mode.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/machine.h"
#include "bench/surface_judge.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/program/progress.h"
#include "demo/scenes/settings.h"
#include "engine/pleat.h"

namespace {

using namespace pleat::bench;
namespace demo = pleat::demo;

using pleat::demo::kBadInput;
constexpr uint32_t kCoarseSides[] = {5, 9, 17};

std::string text(uint32_t n) { return std::to_string(n) + "x" + std::to_string(n); }

void regenerate(const pleat_api& api, const std::filesystem::path& folder) {
  for (const FineSquare& square : kFineSquares) {
    FineSolution solution;
    {
      demo::Progress progress(std::string("solving ") + square.name + ", step", kSolveSteps);
      solution = solve(api, square, [&] { progress.step(); });
    }
    write_fine(folder, square.name, solution.positions);
    std::printf("%-12s moved by at most %.2g mm in the last half second\n", square.name, 1e3 * solution.motion);
  }
}

void print_row(const char* label, std::span<const SurfaceVerdict> verdicts, double SurfaceVerdict::*figure,
               const char* format) {
  std::printf("  %-12s", label);
  for (const SurfaceVerdict& verdict : verdicts) std::printf(format, verdict.*figure);
  std::printf("\n");
}

/// The default settings, changed as the command line asks.
pleat_cloth_settings settings_with(const pleat_api& api, std::span<const std::string> changes) {
  pleat_cloth_def cloth;
  api.cloth_def_init(&cloth, sizeof cloth);
  for (const std::string& change : changes) demo::apply_option(change, cloth.settings);
  return cloth.settings;
}

void compare(const pleat_api& api, const std::filesystem::path& folder, const pleat_cloth_settings& settings,
             demo::OutputOption& json) {
  const std::vector<SurfaceTruth> truths = surface_truths(folder);
  std::vector<uint32_t> modes;
  for (const demo::SettingWord& surface : demo::kSurfaces) modes.push_back(surface.value);
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  std::vector<std::vector<SurfaceVerdict>> verdicts;
  {
    demo::Progress progress("judging, case", uint32_t(truths.size() * std::size(kCoarseSides)));
    for (const SurfaceTruth& truth : truths) {
      for (const uint32_t n : kCoarseSides) {
        verdicts.push_back(judge(api, truth, n, modes, settings));
        progress.step();
      }
    }
  }
  std::printf("%-14s", "");
  for (const demo::SettingWord& surface : demo::kSurfaces) std::printf("%10s", std::string(surface.name).c_str());
  std::printf("\n");
  auto row = verdicts.begin();
  for (const SurfaceTruth& truth : truths) {
    for (const uint32_t n : kCoarseSides) {
      std::printf("%s %s\n", truth.name.c_str(), text(n).c_str());
      print_row("RMS mm", *row, &SurfaceVerdict::rms_mm, "%10.2f");
      print_row("area %", *row, &SurfaceVerdict::area_error_percent, "%+10.2f");
      print_row("us", *row, &SurfaceVerdict::us, "%10.1f");
      nlohmann::ordered_json of_mode;
      for (size_t m = 0; m < modes.size(); ++m) {
        const SurfaceVerdict& v = (*row)[m];
        of_mode[std::string(demo::kSurfaces[m].name)] = {
            {"rms_mm", v.rms_mm}, {"area_error_percent", v.area_error_percent}, {"us", v.us}};
      }
      cases.push_back({{"name", truth.name}, {"coarse", text(n)}, {"modes", of_mode}});
      ++row;
    }
  }
  json.commit(nlohmann::ordered_json{{"cases", cases}, {"machine", describe_machine(api)}});
}

int run_program(int argc, char** argv) {
  CLI::App app(
      "How far the drawn surface is from the truth: over particles that lie on a known surface, the distance of that\n"
      "surface to what is drawn, the error of the area, and what the drawing costs.",
      "surface_error");
  std::filesystem::path folder = PLEAT_FINE_DIR;
  std::vector<std::string> changes;
  bool again = false;
  demo::OutputOption json(app, "--json", "write the figures for scripts");
  app.add_option("--fine", folder, "where the fine solutions are")->type_name("DIR")->capture_default_str();
  app.add_option("--set", changes, "a setting of the cloth, see `pleat list`")->type_name("KEY=VALUE");
  app.add_flag("--regenerate", again, "compute the fine solutions anew (some minutes) and keep them there");
  if (const auto status = demo::parse(app, argc, argv)) return *status;

  const pleat_api& api = pleat::demo::library();
  const pleat_cloth_settings settings = settings_with(api, changes);
  json.open();
  if (again) {
    require_folder(folder);
    regenerate(api, folder);
  }
  compare(api, folder, settings, json);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return pleat::demo::run_main("surface_error", [=] { return run_program(argc, argv); });
}
