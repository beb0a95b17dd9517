#include "bench/error/scoreboard.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace pleat::bench {
namespace {

constexpr double kPeerBar = 10.0, kFlatBar = 8.0;  // times pleat's time at equal error

std::string text(Grid grid) { return std::to_string(grid.rows) + "x" + std::to_string(grid.columns); }

template <class F>
std::vector<TimeAndError> points_of(const std::vector<Score>& scores, F wanted) {
  std::vector<TimeAndError> points;
  for (const Score& score : scores) {
    if (wanted(score)) points.push_back({score.ms, 1e3 * score.error.rms});
  }
  return points;
}

std::vector<TimeAndError> sorted_front(const std::vector<TimeAndError>& points) {
  std::vector<TimeAndError> front;
  for (const size_t i : pareto_front(points)) front.push_back(points[i]);
  return front;
}

bool by_peer(const Score& score) { return score.peer; }
bool drawn_flat(const Score& score) { return score.method.starts_with("flat"); }

bool on_front(const Score& score, const std::vector<TimeAndError>& front) {
  return std::ranges::any_of(
      front, [&](const TimeAndError& p) { return p.time == score.ms && p.error == 1e3 * score.error.rms; });
}

void print_scene(const SceneScores& of_scene) {
  const RestScene& scene = *of_scene.scene;
  std::printf("\n%s: %s\n", std::string(scene.name).c_str(), std::string(scene.title).c_str());
  std::printf(
      "the truth moves by RMS %.3f mm, at most %.2f mm, normals %.2f degrees, from half its mesh to all of it\n",
      1e3 * of_scene.halving.rms, 1e3 * of_scene.halving.hausdorff, of_scene.halving.normal_rms_deg);
  std::printf("  %-23s %-44s %7s %7s %9s %8s %8s %8s %6s %7s\n", "method", "dynamics", "grid", "drawn", "ms/frame",
              "RMS mm", "max mm", "normal", "IoU %", "area %");
  const std::vector<TimeAndError> front = sorted_front(points_of(of_scene.scores, [](const Score&) { return true; }));
  const std::vector<TimeAndError> peer_front = sorted_front(points_of(of_scene.scores, by_peer));
  for (const Score& s : of_scene.scores) {
    if (s.peer && !on_front(s, peer_front)) continue;
    std::printf("%c %-23s %-44s %7s %7zu %9.4f %8.2f %8.1f %8.2f %6.1f %+7.2f\n", on_front(s, front) ? '*' : ' ',
                s.method.c_str(), s.dynamics.c_str(), text(s.grid).c_str(), s.drawn_triangles, s.ms, 1e3 * s.error.rms,
                1e3 * s.error.hausdorff, s.error.normal_rms_deg, 100.0 * s.silhouette_overlap, s.area_error_percent);
  }
}

/// Band by band, mm2.
nlohmann::ordered_json to_json(const WrinkleSpectrum& spectrum) {
  nlohmann::ordered_json bands = nlohmann::ordered_json::array();
  for (const double energy : spectrum) bands.push_back(1e6 * energy);
  return bands;
}

std::string ratio_text(const std::optional<double>& ratio) {
  char word[24] = "not reached";
  if (ratio) std::snprintf(word, sizeof word, "%.2f", *ratio);
  return word;
}

}  // namespace

std::vector<EqualError> equal_errors(const SceneScores& of_scene) {
  const std::vector<TimeAndError> flat = points_of(of_scene.scores, drawn_flat),
                                  peer = points_of(of_scene.scores, by_peer);
  std::vector<EqualError> rows;
  for (const Score& score : of_scene.scores) {
    if (score.method != "pleat") continue;
    const auto ratio = [&](const std::vector<TimeAndError>& points) -> std::optional<double> {
      const std::optional<double> time = time_to_error(points, 1e3 * score.error.rms);
      return time ? std::optional(*time / score.ms) : std::nullopt;
    };
    rows.push_back({score.grid, score.ms, score.error.rms, ratio(flat), ratio(peer)});
  }
  return rows;
}

void print_scores(const std::vector<SceneScores>& all) {
  std::printf(
      "* no other is both faster and closer. Bullet: of the settings searched, those that none of them beats.\n");
  for (const SceneScores& of_scene : all) print_scene(of_scene);
  std::printf("\ntime to pleat's RMS error, over pleat's time  %22s %12s\n", "own simulation, flat", "Bullet");
  int rows = 0, flat_met = 0, peer_met = 0;
  for (const SceneScores& of_scene : all) {
    for (const EqualError& row : equal_errors(of_scene)) {
      std::printf("  %-12s %6s %9.4f ms %8.2f mm  %22s %12s\n", std::string(of_scene.scene->name).c_str(),
                  text(row.grid).c_str(), row.ms, 1e3 * row.rms, ratio_text(row.flat_ratio).c_str(),
                  ratio_text(row.peer_ratio).c_str());
      ++rows;
      flat_met += !row.flat_ratio || *row.flat_ratio >= kFlatBar;
      peer_met += !row.peer_ratio || *row.peer_ratio >= kPeerBar;
    }
  }
  std::printf("bars met (not reached counts): own flat %g times, %d of %d; Bullet %g times, %d of %d\n", kFlatBar,
              flat_met, rows, kPeerBar, peer_met, rows);
}

nlohmann::ordered_json scores_json(const std::vector<SceneScores>& all) {
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  for (const SceneScores& of_scene : all) {
    nlohmann::ordered_json scores = nlohmann::ordered_json::array(), equal = nlohmann::ordered_json::array();
    for (const Score& s : of_scene.scores) {
      scores.push_back({{"method", s.method},
                        {"dynamics", s.dynamics},
                        {"grid", text(s.grid)},
                        {"particles", s.grid.particles()},
                        {"drawn_triangles", s.drawn_triangles},
                        {"ms", s.ms},
                        {"rms_mm", 1e3 * s.error.rms},
                        {"hausdorff_mm", 1e3 * s.error.hausdorff},
                        {"normal_rms_deg", s.error.normal_rms_deg},
                        {"silhouette_overlap_percent", 100.0 * s.silhouette_overlap},
                        {"area_error_percent", s.area_error_percent},
                        {"edge_error_median_percent", s.edges.median_percent},
                        {"edge_error_p99_percent", s.edges.p99_percent},
                        {"wrinkle_energy_mm2", to_json(s.wrinkles)}});
    }
    for (const EqualError& row : equal_errors(of_scene)) {
      nlohmann::ordered_json entry = {{"grid", text(row.grid)}, {"ms", row.ms}, {"rms_mm", 1e3 * row.rms}};
      if (row.flat_ratio) entry["flat_ratio"] = *row.flat_ratio;
      if (row.peer_ratio) entry["peer_ratio"] = *row.peer_ratio;
      equal.push_back(entry);
    }
    scenes.push_back({{"name", of_scene.scene->name},
                      {"reference_halving",
                       {{"rms_mm", 1e3 * of_scene.halving.rms},
                        {"hausdorff_mm", 1e3 * of_scene.halving.hausdorff},
                        {"normal_rms_deg", of_scene.halving.normal_rms_deg}}},
                      {"wrinkle_band_ends", kBandEnds},
                      {"reference_wrinkle_energy_mm2", to_json(of_scene.wrinkles)},
                      {"scores", scores},
                      {"time_to_equal_error", equal}});
  }
  return scenes;
}

std::string draw_scores(const std::vector<SceneScores>& all) {
  std::vector<Panel> panels;
  for (const SceneScores& of_scene : all) {
    Panel panel{std::string(of_scene.scene->title), {}};
    for (const Score& score : of_scene.scores) {
      const auto same = [&](const Curve& curve) { return curve.name == score.method; };
      if (score.peer || std::ranges::any_of(panel.curves, same)) continue;
      panel.curves.push_back(
          {score.method, points_of(of_scene.scores, [&](const Score& s) { return s.method == score.method; })});
    }
    for (Curve& curve : panel.curves) std::ranges::sort(curve.points, {}, &TimeAndError::time);
    panel.curves.push_back({"Bullet's soft body, best settings", sorted_front(points_of(of_scene.scores, by_peer))});
    panels.push_back(std::move(panel));
  }
  return log_charts("Distance from the truth at rest, against the cost of a frame of 1/60 s", "ms a frame",
                    "RMS distance, mm", panels);
}

}  // namespace pleat::bench
