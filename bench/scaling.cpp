// The program `scaling`: whether what a frame costs grows with the number of particles, and no faster.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/scaling/growth.h"
#include "bench/scaling/growth_chart.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/program/progress.h"

namespace {

namespace demo = pleat::demo;
using namespace pleat::bench;

struct Range {
  const char* scene;
  std::vector<uint32_t> sizes;
};

const std::vector<Range> kFull = {{"hanging_square", {8, 11, 16, 23, 32, 45, 64, 91, 128}},
                                  {"crowd", {1, 4, 16, 63, 250, 1000, 4000}}};
const std::vector<Range> kQuick = {{"hanging_square", {8, 16, 32}}, {"crowd", {1, 8, 64}}};

void print(const Growth& growth) {
  std::printf("%-16s %10s %12s %14s %14s %9s %8s %14s\n", growth.scene.c_str(), "particles", "us a frame",
              "ns a particle", "over middle's", "substeps", "passes", "longest edge %");
  for (const SizeCost& cost : growth.sizes) {
    std::printf("%16u %10llu %12.0f %14.0f %14.2f %9u %8llu %14.2f\n", cost.size,
                static_cast<unsigned long long>(cost.particles), cost.us, cost.ns_a_particle(), growth.ratio(cost),
                cost.substeps, static_cast<unsigned long long>(cost.passes), cost.longest_edge);
  }
}

nlohmann::ordered_json json_of(const Growth& growth) {
  auto sizes = nlohmann::ordered_json::array();
  for (const SizeCost& cost : growth.sizes) {
    sizes.push_back({{"size", cost.size},
                     {"particles", cost.particles},
                     {"us", cost.us},
                     {"ratio", growth.ratio(cost)},
                     {"substeps", cost.substeps},
                     {"passes", cost.passes},
                     {"longest_edge_percent", cost.longest_edge}});
  }
  return {{"scene", growth.scene}, {"sizes", sizes}};
}

int run_program(int argc, char** argv) {
  CLI::App app(
      "What half a second of hanging_square:8..128 and of crowd:1..4000 costs for each particle, in processor time.\n"
      "Passes: of the strain limit over a cloth in the last frame; deep cloth needs more.",
      "scaling");
  bool quick = false;
  uint32_t rounds = 3;
  app.add_flag("--quick", quick, "three sizes each, up to 32 and 64");
  app.add_option("--rounds", rounds, "in which all sizes run in turn; the least of a frame counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  demo::OutputOption svg(app, "--svg", "draw it");
  demo::OutputOption json(app, "--json", "write the figures for scripts");
  if (const auto status = demo::parse(app, argc, argv)) return *status;

  const pleat_api& api = demo::library();
  svg.open();
  json.open();
  std::vector<Growth> scenes;
  {
    const std::vector<Range>& ranges = quick ? kQuick : kFull;
    uint32_t runs = 0;
    for (const Range& range : ranges) runs += rounds * uint32_t(range.sizes.size());
    demo::Progress progress("growing, run", runs);
    for (const Range& range : ranges) {
      scenes.push_back(measure_growth(api, range.scene, range.sizes, rounds, [&] { progress.step(); }));
    }
  }
  auto figures = nlohmann::ordered_json::array();
  for (const Growth& growth : scenes) {
    if (&growth != &scenes.front()) std::printf("\n");
    print(growth);
    figures.push_back(json_of(growth));
  }
  svg.commit(growth_chart(scenes));
  json.commit(nlohmann::ordered_json{{"scenes", figures}, {"machine", describe_machine(api)}});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return demo::run_main("scaling", [=] { return run_program(argc, argv); });
}
