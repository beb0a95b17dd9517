#include "bench/budget_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "bench/machine.h"
#include "demo/quality/scene_quality.h"

namespace pleat::bench {
namespace {

using demo::Quality;
using demo::Spread;

nlohmann::ordered_json to_json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"p99", spread.p99}};
}

nlohmann::ordered_json to_json(const std::vector<std::pair<std::string, Spread>>& spreads) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, spread] : spreads) json[name] = to_json(spread);
  return json;
}

void print_row(const char* name, const Spread& spread) {
  std::printf("%-28s %10.1f %10.1f %10.1f\n", name, spread.median, spread.min, spread.p99);
}

/// The paper: 66 particles, 108 triangles, 1944 drawn, Pentium III at 800 MHz, ms a frame.
void print_beside_paper(const Budget& budget) {
  const struct {
    const char* part;
    double paper_ms, ours_us;
  } rows[] = {{"integration", 3.5, stage_sum(budget.stages, kIntegrationStages)},
              {"collision", 14.7, stage_sum(budget.stages, kCollisionStages)},
              {"smoothing", 6.4, stage_sum(budget.stages, kSmoothingStages)}};
  std::printf("\n%-28s %10s %10s\n", "beside the paper (2001)", "paper ms", "ours ms");
  for (const auto& [part, paper_ms, ours_us] : rows)
    std::printf("  %-26s %10.1f %10.4f\n", part, paper_ms, 0.001 * ours_us);
  if (!budget.pn_smoothing) return;
  std::printf("  %-26s %10.1f %10.4f\n", "smoothing, PN alone", 4.0, 0.001 * *budget.pn_smoothing);
  std::printf("  %-26s %10.1f %10.2f\n", "full / PN alone", 1.6, rows[2].ours_us / *budget.pn_smoothing);
}

void print_quality(const Quality& quality) {
  const nlohmann::ordered_json json = to_json(quality);
  std::printf("\n");
  for (const auto& [name, value] : json.items()) std::printf("%-28s %10.4f\n", name.c_str(), value.get<double>());
}

void print_peer(const Peer& peer) {
  std::printf("\nBullet's soft body %s, %d iterations, its bare particles\n", BulletScene::version().c_str(),
              peer.settings.iterations);
  print_row("frame", peer.frame);
  print_quality(peer.quality);
  std::printf("%-28s %10.2f\n", "our frame / its frame", peer.ratio_frame);
  std::printf("%-28s %10.2f\n", "our dynamics / its frame", peer.ratio_dynamics);
}

/// Of what is measured of a drawn surface, in the order of the report.
constexpr struct {
  const char* name;
  double demo::SurfaceMotion::*value;
} kSurfaceRows[] = {{"normal_turn_deg", &demo::SurfaceMotion::normal_turn_deg},
                    {"flat_turn_deg", &demo::SurfaceMotion::flat_turn_deg},
                    {"acceleration_mm", &demo::SurfaceMotion::acceleration_mm},
                    {"length_rms_percent", &demo::SurfaceMotion::length_rms_percent},
                    {"area_mean_percent", &demo::SurfaceMotion::area_mean_percent},
                    {"area_worst_percent", &demo::SurfaceMotion::area_worst_percent}};

/// By phase; none where PN alone was not asked, or had no motion to compare with.
std::vector<std::pair<const char*, double>> accelerations_over_pn(const Budget& budget) {
  std::vector<std::pair<const char*, double>> ratios;
  const auto add = [&](const char* phase, const demo::SurfaceMotion& ours, const demo::SurfaceMotion& pn) {
    if (pn.acceleration_mm > 0.0) ratios.emplace_back(phase, ours.acceleration_mm / pn.acceleration_mm);
  };
  if (!budget.pn_surface || budget.pn_surface->moving.acceleration_mm == 0.0) return ratios;
  add("moving", budget.surface.moving, budget.pn_surface->moving);
  if (budget.surface.resting) add("after", *budget.surface.resting, *budget.pn_surface->resting);
  return ratios;
}

/// A column each of the surface while the body moves and after it, then of PN alone.
void print_surface(const Budget& budget) {
  std::vector<std::pair<const char*, demo::SurfaceMotion>> columns;
  const auto add = [&](const demo::SceneSurface& surface, const char* moving, const char* resting) {
    columns.emplace_back(moving, surface.moving);
    if (surface.resting) columns.emplace_back(resting, *surface.resting);
  };
  add(budget.surface, "moving", "after");
  if (budget.pn_surface) add(*budget.pn_surface, "PN moving", "PN after");

  std::printf("\n%-28s", "drawn surface");
  for (const auto& [title, motion] : columns) std::printf(" %10s", title);
  std::printf("\n");
  for (const auto& [name, value] : kSurfaceRows) {
    std::printf("  %-26s", name);
    for (const auto& [title, motion] : columns) std::printf(" %10.3f", motion.*value);
    std::printf("\n");
  }
  const auto ratios = accelerations_over_pn(budget);
  if (ratios.empty()) return;
  std::printf("  %-26s", "acceleration_over_pn");
  for (const auto& [phase, ratio] : ratios) std::printf(" %10.3f", ratio);
  std::printf("\n");
}

nlohmann::ordered_json to_json(const demo::SurfaceMotion& motion) {
  nlohmann::ordered_json json;
  for (const auto& [name, value] : kSurfaceRows) json[name] = motion.*value;
  return json;
}

nlohmann::ordered_json to_json(const demo::SceneSurface& surface) {
  nlohmann::ordered_json json = {{"moving", to_json(surface.moving)}};
  if (surface.resting) json["after"] = to_json(*surface.resting);
  return json;
}

}  // namespace

void print_budget(const demo::SceneDef& def, const Budget& budget) {
  std::printf("%s at %g Hz, %u frames, %u runs; %u particles, %u triangles, %u drawn; %u substeps", def.name.c_str(),
              def.rate, def.frames, budget.repeat, budget.cloth.particles, budget.cloth.triangles,
              budget.cloth.drawn_triangles, budget.cloth.substeps);
  std::printf(budget.cloths > 1 ? "; %zu copies\n" : "\n", budget.cloths);
  std::printf("%-28s %10s %10s %10s\n", "us a frame", "median", "min", "p99");
  print_row("frame", budget.frame);
  for (const auto& [name, spread] : budget.stages) print_row(("  " + name).c_str(), spread);
  if (budget.allocations_per_frame) std::printf("%-28s %10.3f\n", "allocations a frame", *budget.allocations_per_frame);
  if (def.budget > 0.0) {
    std::printf("given up for %g ms a tick     folds of %llu cloths, substeps of %llu, ticks of %llu\n", def.budget,
                static_cast<unsigned long long>(budget.folds_given_up),
                static_cast<unsigned long long>(budget.substeps_given_up),
                static_cast<unsigned long long>(budget.ticks_given_up));
  }
  if (budget.invisible > 0) {
    std::printf("out of sight                 %llu cloths\n", static_cast<unsigned long long>(budget.invisible));
  }
  print_beside_paper(budget);
  print_quality(budget.quality);
  print_surface(budget);
  if (budget.peer) print_peer(*budget.peer);
}

nlohmann::ordered_json budget_json(const pleat_api& api, const demo::SceneDef& def, const Budget& budget) {
  nlohmann::ordered_json json = {{"scene", def.name},
                                 {"rate_hz", def.rate},
                                 {"frames", def.frames},
                                 {"repeat", budget.repeat},
                                 {"cloths", budget.cloths},
                                 {"particles", budget.cloth.particles},
                                 {"triangles", budget.cloth.triangles},
                                 {"drawn_vertices", budget.cloth.drawn_vertices},
                                 {"drawn_triangles", budget.cloth.drawn_triangles},
                                 {"substeps", budget.cloth.substeps},
                                 {"stages_us", to_json(budget.stages)},
                                 {"systems_us", to_json(budget.systems)},
                                 {"frame_us", to_json(budget.frame)}};
  if (budget.pn_smoothing) json["smoothing_pn_only_us"] = *budget.pn_smoothing;
  json["per_particle_us"] = budget.frame.median / double(budget.cloth.particles * budget.cloths);
  if (budget.allocations_per_frame) json["allocations_per_frame"] = *budget.allocations_per_frame;
  if (def.budget > 0.0) {
    json["budget_ms"] = def.budget;
    json["folds_given_up"] = budget.folds_given_up;
    json["substeps_given_up"] = budget.substeps_given_up;
    json["ticks_given_up"] = budget.ticks_given_up;
  }
  if (budget.invisible > 0) json["invisible"] = budget.invisible;
  json["bytes_per_cloth"] = budget.cloth.bytes;
  json["quality"] = to_json(budget.quality);
  json["surface"] = to_json(budget.surface);
  for (const auto& [phase, ratio] : accelerations_over_pn(budget))
    json["surface"][phase]["acceleration_over_pn"] = ratio;
  if (budget.pn_surface) json["pn_surface"] = to_json(*budget.pn_surface);
  if (const auto& peer = budget.peer) {
    json["peer"] = {{"name", "Bullet soft body"},
                    {"version", BulletScene::version()},
                    {"iterations", peer->settings.iterations},
                    {"frame_us", to_json(peer->frame)},
                    {"quality", to_json(peer->quality)},
                    {"ratio_frame", peer->ratio_frame},
                    {"ratio_dynamics", peer->ratio_dynamics}};
  }
  json["machine"] = describe_machine(api);
  return json;
}

}  // namespace pleat::bench
