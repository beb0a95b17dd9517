#include "demo/report.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "demo/quality/scene_quality.h"

namespace pleat::demo {
namespace {

void print_quality(const Quality& quality) {
  std::printf("stretch       %.2f %% at most, %.2f %% in 99 of 100 frames; strain RMS %.2f %%\n",
              quality.strain_max_percent, quality.strain_p99_percent, quality.strain_rms_percent);
  if (quality.penetration_particle_mm) {
    std::printf("penetration   particles %.2f mm, triangles %.2f mm, drawn surface %.2f mm\n",
                *quality.penetration_particle_mm, *quality.penetration_interior_mm, *quality.penetration_drawn_mm);
  }
  if (quality.rest_jitter_mm)
    std::printf("rest jitter   %.4f mm a frame; the fastest particle %.3f cm/s\n", *quality.rest_jitter_mm,
                *quality.rest_speed_cm_s);
}

void print_events(const pleat_stats& stats) {
  const struct {
    const char* what;
    uint64_t count;
  } events[] = {{"contacts dropped", stats.contacts_dropped},
                {"edges skipped", stats.edges_skipped},
                {"bodies faster than substeps", stats.fast_bodies},
                {"ticks with stiffness lowered", stats.stiffness_lowered},
                {"teleports", stats.teleports},
                {"ticks begun anew", stats.rollbacks},
                {"ticks without a good end", stats.fallbacks},
                {"non-finite values put back", stats.nonfinite_restored}};
  for (const auto& [what, count] : events) {
    if (count > 0) std::printf("event         %s: %llu\n", what, static_cast<unsigned long long>(count));
  }
}

}  // namespace

void print_report(const SceneDef& def, const RunRecord& record) {
  std::printf("scene         %s, %u frames at %g Hz, %u substeps a frame\n", def.name.c_str(), def.frames, def.rate,
              record.cloth.substeps);
  std::printf("cloth         %u particles, %u triangles; drawn %u triangles on %u vertices, %s", record.cloth.particles,
              record.cloth.triangles, record.cloth.drawn_triangles, record.cloth.drawn_vertices,
              record.watertight ? "watertight" : "NOT watertight");
  std::printf(record.cloths > 1 ? "; %zu copies\n" : "\n", record.cloths);
  std::printf("%-24s %9s %9s %9s\n", "stage (us a frame)", "median", "min", "p99");
  double sum = 0.0;
  for (const StageClock::Stage& stage : record.stages) {
    const Spread spread = spread_of(stage.frames);
    std::printf("  %-22s %9.1f %9.1f %9.1f\n", stage.name.c_str(), spread.median, spread.min, spread.p99);
    sum += spread.median;
  }
  std::printf("  %-22s %9.1f\n", "sum of medians", sum);
  print_quality(record.quality);
  print_events(record.stats);
  if (!record.all_finite) std::printf("event         non-finite values were drawn\n");
}

nlohmann::ordered_json report_json(const SceneDef& def, const RunRecord& record,
                                   const std::vector<std::filesystem::path>& files) {
  nlohmann::ordered_json json = {{"scene", def.name},
                                 {"rate", def.rate},
                                 {"frames", def.frames},
                                 {"cloths", record.cloths},
                                 {"particles", record.cloth.particles},
                                 {"triangles", record.cloth.triangles},
                                 {"drawn_triangles", record.cloth.drawn_triangles},
                                 {"drawn_vertices", record.cloth.drawn_vertices},
                                 {"border_edges", record.border_edges},
                                 {"watertight", record.watertight},
                                 {"all_finite", record.all_finite},
                                 {"substeps", record.cloth.substeps}};
  for (const StageClock::Stage& stage : record.stages) {
    const Spread spread = spread_of(stage.frames);
    json["stages_us"][stage.name] = {{"median", spread.median}, {"min", spread.min}, {"p99", spread.p99}};
  }
  json["quality"] = to_json(record.quality);
  json["files"] = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file : files) json["files"].push_back(file.string());
  return json;
}

}  // namespace pleat::demo
