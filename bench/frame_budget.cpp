// The program `frame_budget`: what a frame of a scene costs, stage by stage, and how good the cloth is for it.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/budget.h"
#include "bench/budget_report.h"
#include "bench/starts.h"
#include "demo/program/entry.h"
#include "demo/program/options.h"
#include "demo/scenes/scene_reader.h"
#include "engine/pleat.h"

namespace {

using pleat::demo::kBadInput;

/// None where the text names no peer.
std::optional<pleat::bench::BulletSettings> parse_peer(const std::string& text) {
  pleat::bench::BulletSettings settings;
  if (text == "bullet") return settings;
  const std::string prefix = "bullet:";
  if (!text.starts_with(prefix)) return {};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + prefix.size(), end, settings.iterations);
  if (error != std::errc() || stop != end || settings.iterations < 1 || settings.iterations > 1000) return {};
  return settings;
}

int run_program(int argc, char** argv) {
  CLI::App app("What a frame of a scene costs, and how good the cloth is for it.", "frame_budget");
  pleat::demo::SceneRequest request;
  request.scene = "skirt_kick";
  uint32_t repeat = 5;
  uint32_t starts = 1;
  uint32_t threads = 1;
  app.add_option("--scene", request.scene, "a scene of `pleat list` or the path of a JSON file")->capture_default_str();
  app.add_option("--clip", request.clip, "in place of the scene's motion")
      ->type_name("BVH")
      ->check(pleat::demo::named());
  app.add_option("--speed", request.speed, "times as fast as the scene's motion is")
      ->check(pleat::demo::between(0.01, 100.0));
  app.add_option("--rate", request.rate, "frames a second")->type_name("HZ")->check(pleat::demo::between(1.0, 10000.0));
  app.add_option("--frames", request.frames, "how many frames")->type_name("N")->check(CLI::Range(1, 1000000));
  app.add_option("--repeat", repeat, "runs; the best counts")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--starts", starts, "also the worst quality from that many starts, 1 mm apart")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option_function<std::string>(
      "--surface", [&](const std::string& mode) { request.settings.push_back("surface=" + mode); },
      "flat, pn, paper, pleat (default), phong, spherigon or arc-pn");
  app.add_option("--threads", threads, "that run cloths; systems are timed one by one with a single one")
      ->check(CLI::Range(1u, PLEAT_MAX_WORKERS))
      ->capture_default_str();
  double tick_budget = 0.0;
  std::optional<size_t> seen;
  app.add_option("--budget", tick_budget, "level of detail: what a tick of all cloths may take; the first is nearest")
      ->type_name("MS")
      ->check(pleat::demo::between(0.001, 1e6));
  app.add_option("--seen", seen, "copies of a crowd that are in sight, the first ones")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  std::string peer;
  app.add_option("--peer", peer, "in turn with Bullet's soft body, `bullet`, or `bullet:N` for N iterations, not 4")
      ->check(CLI::Validator([](std::string& text) { return parse_peer(text) ? "" : "not bullet or bullet:1..1000"; },
                             "PEER"));
  pleat::demo::OutputOption json(app, "--json", "write the figures for scripts");
  if (const auto status = pleat::demo::parse(app, argc, argv)) return *status;

  const pleat_api& api = pleat::demo::library();
  pleat::demo::SceneDef def = pleat::demo::load_scene(api, request);
  def.workers = threads;
  def.budget = tick_budget;
  if (seen) def.seen = *seen;
  json.open();
  const pleat::bench::Budget budget = pleat::bench::measure_budget(api, def, repeat, parse_peer(peer));
  std::vector<pleat::bench::Start> from_starts;
  if (starts > 1) from_starts = pleat::bench::measure_starts(api, def, starts);
  if (json) {
    nlohmann::ordered_json figures = pleat::bench::budget_json(api, def, budget);
    if (starts > 1) figures["starts"] = pleat::bench::starts_json(from_starts);
    json.commit(figures);
  }
  pleat::bench::print_budget(def, budget);
  if (starts > 1) pleat::bench::print_starts(from_starts);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return pleat::demo::run_main("frame_budget", [=] { return run_program(argc, argv); });
}
