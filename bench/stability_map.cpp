// The program `stability_map`: stiff and extreme cloths, cell by cell, and what is left of them.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/stability/events.h"
#include "bench/stability/grid.h"
#include "bench/stability/heat_map.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/program/progress.h"
#include "demo/scenes/scene_reader.h"
#include "demo/scenes/settings.h"
#include "engine/pleat.h"

namespace {

using namespace pleat::bench;
namespace demo = pleat::demo;

using Counts = std::array<size_t, kFateNames.size()>;

std::string name_of(uint32_t integrator) {
  return std::string(std::ranges::find(demo::kIntegrators, integrator, &demo::SettingWord::value)->name);
}

demo::SceneDef hanging_square(const pleat_api& api) {
  demo::SceneRequest request;
  request.scene = "hanging_square:16";
  return demo::load_scene(api, request);
}

Counts count(std::span<const CellResult> results) {
  Counts counts{};
  for (const CellResult& result : results) ++counts[size_t(result.fate)];
  return counts;
}

/// Cells in which nothing exploded in the sense of the workloads: finite, within 1 km, strain up to 1000 %.
bool unbroken(const Counts& counts) {
  return counts[size_t(Fate::kAbove1000)] + counts[size_t(Fate::kFarAway)] + counts[size_t(Fate::kNonfinite)] == 0;
}

void print_row(const std::string& name, const Counts& counts, size_t cells) {
  std::printf("%-18s%7zu", name.c_str(), cells);
  for (const size_t n : counts) std::printf("%17zu", n);
  std::printf("%11.1f %%\n", 100.0 * double(counts[0]) / double(cells));
}

void add_counts(nlohmann::ordered_json& to, const Counts& counts, size_t cells) {
  to["cells"] = cells;
  for (size_t f = 0; f < counts.size(); ++f) to[std::string(kFateNames[f])] = counts[f];
}

/// Runs the grid, prints a row for each integrator; true where nothing broke.
bool run_grid(const pleat_api& api, const demo::SceneDef& scene, const StabilityGrid& grid,
              nlohmann::ordered_json& figures, demo::OutputOption& svg) {
  demo::Progress progress("stability map, cell", uint32_t(grid.cells()));
  std::vector<CellResult> results;
  for (size_t i = 0; i < grid.cells(); ++i) {
    results.push_back(run_cell(api, scene, grid.cell(i), grid.seconds));
    progress.step();
  }

  nlohmann::ordered_json by_integrator = nlohmann::ordered_json::array();
  add_counts(figures, count(results), results.size());
  std::vector<std::string> names;
  std::printf("%-18s%7s", "integrator", "cells");
  for (const std::string_view fate : kFateNames) std::printf("%17.*s", int(fate.size()), fate.data());
  std::printf("%13s\n", "below 10 %");
  for (size_t k = 0; k < grid.integrators.size(); ++k) {
    names.push_back(name_of(grid.integrators[k]));
    const size_t cells = grid.cells_of_integrator();
    const Counts counts = count(std::span(results).subspan(k * cells, cells));
    print_row(names.back(), counts, cells);
    add_counts(by_integrator.emplace_back(nlohmann::ordered_json{{"name", names.back()}}), counts, cells);
  }
  figures["integrators"] = by_integrator;
  svg.commit(heat_map(grid, results, names));
  return unbroken(count(results));
}

/// Lets each event happen, prints a row for each; true where none failed.
bool run_events(const pleat_api& api, const demo::SceneDef& scene, long rest_ticks, nlohmann::ordered_json& figures) {
  const std::vector<Event> all = events(rest_ticks);
  demo::Progress progress("stability map, event", uint32_t(all.size()));
  std::vector<EventResult> results;
  for (const Event& event : all) {
    results.push_back(run_event(api, scene, event));
    progress.step();
  }
  print_events(results);
  figures["events"] = events_json(results);
  return std::ranges::find(results, "failed", &EventResult::outcome) == results.end();
}

int run_program(int argc, char** argv) {
  CLI::App app(
      "A square of 16 x 16 particles hangs from two corners: nine decades of stiffness, ticks from 1/240 to 1/10 s, "
      "hems\n"
      "up to 10,000 times as heavy as the cloth, up to 100 times the earth's gravity, each integrator. Says how far "
      "the\n"
      "worst edge is stretched at the end. Then what happens to cloth in games and should not: teleports, storms, bad "
      "input.\n"
      "Exits 1 when a cell is not finite, thrown away, or above 1000 %, or an event leaves more than 10 %.",
      "stability_map");
  bool quick = false, full = false, only_events = false;
  std::vector<std::string> words;
  std::vector<std::string> known;
  for (const demo::SettingWord& word : demo::kIntegrators) known.emplace_back(word.name);
  auto* quick_flag = app.add_flag("--quick", quick, "some corners of the grid, 1 s each (what the tests run)");
  app.add_flag("--full", full, "the whole grid, 2 s each (default), and a million ticks at rest")->excludes(quick_flag);
  auto* events_flag = app.add_flag("--events", only_events, "only the events");
  app.add_option("--integrator", words, "only this one's grid; may be repeated")
      ->type_name("NAME")
      ->check(CLI::IsMember(known))
      ->excludes(events_flag);
  demo::OutputOption svg(app, "--svg", "draw a heat map");
  svg.option().excludes(events_flag);
  demo::OutputOption json(app, "--json", "write the figures for scripts");
  if (const auto status = demo::parse(app, argc, argv)) return *status;

  const pleat_api& api = demo::library();
  const demo::SceneDef scene = hanging_square(api);
  StabilityGrid grid = quick ? quick_grid() : full_grid();
  if (!words.empty()) {
    std::erase_if(grid.integrators, [&](uint32_t i) { return std::ranges::find(words, name_of(i)) == words.end(); });
  }
  json.open();
  svg.open();

  nlohmann::ordered_json figures;
  bool good = true;
  if (!only_events) good = run_grid(api, scene, grid, figures, svg);
  if (words.empty()) good = run_events(api, scene, full ? 1'000'000 : quick ? 0 : 20'000, figures) && good;
  figures["machine"] = describe_machine(api);
  json.commit(figures);
  return good ? 0 : demo::kOwnFailure;
}

}  // namespace

int main(int argc, char** argv) {
  return pleat::demo::run_main("stability_map", [=] { return run_program(argc, argv); });
}
