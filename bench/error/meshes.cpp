#include "bench/error/meshes.h"

#include <time.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/error/contestant.h"
#include "bench/error/log_chart.h"
#include "bench/metrics/surface_distance.h"
#include "demo/input_error.h"

namespace pleat::bench {
namespace {

constexpr std::array<const char*, kPatterns> kNames = {"squares, diagonals alternate", "squares, diagonals one way",
                                                       "staggered rows"};

const char* name_of(Pattern pattern) { return kNames[size_t(pattern)]; }

bool pins_middle(const RestScene& scene) { return scene.pinned(0.5, 0.0) && !scene.pinned(0.4, 0.0); }

/// ms that this thread has had the processor.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

MeshScore score(const pleat_api& api, const RestScene& scene, const pleat_cloth_settings& settings, Grid grid,
                const demo::TriangleMesh& truth) {
  Contestant contestant(api, scene, {"default", grid, settings, {}});
  const double start = processor_time();
  settle(contestant);
  const double ms = (processor_time() - start) / kSettleFrames;
  return {grid, ms, surface_distance(contestant.surface(), truth).rms};
}

}  // namespace

std::vector<MeshScores> score_meshes(const pleat_api& api, const RestScene& scene, const pleat_cloth_settings& settings,
                                     const Reference& reference, const std::function<void()>& step) {
  const demo::TriangleMesh truth = reference_surface(api, reference.fine);
  std::vector<MeshScores> all;
  for (const Pattern pattern : {Pattern::kAlternating, Pattern::kOneWay, Pattern::kStaggered}) {
    if (pattern != Pattern::kStaggered || !pins_middle(scene)) {
      MeshScores& scores = all.emplace_back(MeshScores{pattern, {}});
      for (Grid grid : scene.coarse) {
        grid.pattern = pattern;
        scores.of_densities.push_back(score(api, scene, settings, grid, truth));
      }
    }
    step();
  }
  return all;
}

void print_meshes(const RestScene& scene, const std::vector<MeshScores>& all) {
  std::printf("\n%s: %s; particles: ms, RMS mm\n", std::string(scene.name).c_str(), std::string(scene.title).c_str());
  for (const MeshScores& scores : all) {
    std::printf("  %-30s", name_of(scores.pattern));
    for (const MeshScore& s : scores.of_densities) {
      std::printf("%6u: %6.3f, %6.2f", s.grid.particles(), s.ms, 1e3 * s.rms);
    }
    std::printf("\n");
  }
}

nlohmann::ordered_json meshes_json(const std::vector<MeshScores>& all) {
  nlohmann::ordered_json patterns;
  for (const MeshScores& scores : all) {
    nlohmann::ordered_json& rows = patterns[name_of(scores.pattern)] = nlohmann::ordered_json::array();
    for (const MeshScore& s : scores.of_densities) {
      rows.push_back({{"particles", s.grid.particles()}, {"ms", s.ms}, {"rms_mm", 1e3 * s.rms}});
    }
  }
  return patterns;
}

EarlierCurve read_earlier(const std::filesystem::path& file) {
  try {
    std::ifstream in(file);
    const nlohmann::json all = nlohmann::json::parse(in);
    EarlierCurve curve{all.at("name"), {}};
    for (const auto& [scene, rows] : all.at("scenes").items()) {
      for (const nlohmann::json& row : rows) curve.scenes[scene].push_back({row.at("ms"), row.at("rms_mm")});
    }
    return curve;
  } catch (const nlohmann::json::exception& error) {
    throw demo::InputError(file.string(), error.what());
  }
}

std::string draw_meshes(const std::vector<const RestScene*>& scenes, const std::vector<std::vector<MeshScores>>& all,
                        const EarlierCurve& earlier) {
  std::vector<Panel> panels;
  for (size_t i = 0; i < scenes.size(); ++i) {
    Panel panel{std::string(scenes[i]->title), {}};
    for (const MeshScores& scores : all[i]) {
      Curve& curve = panel.curves.emplace_back(Curve{name_of(scores.pattern), {}});
      for (const MeshScore& s : scores.of_densities) curve.points.push_back({s.ms, 1e3 * s.rms});
    }
    const auto before = earlier.scenes.find(std::string(scenes[i]->name));
    if (before != earlier.scenes.end()) panel.curves.push_back({earlier.name, before->second});
    panels.push_back(std::move(panel));
  }
  return log_charts("Pleat's distance from the truth at rest by mesh, and earlier, over the cost of a frame of 1/60 s",
                    "ms a frame", "RMS distance, mm", panels);
}

}  // namespace pleat::bench
