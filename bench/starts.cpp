#include "bench/starts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

#include "demo/program/progress.h"
#include "demo/quality/scene_quality.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"

namespace pleat::bench {
namespace {

using demo::Scene;

constexpr double kWatch = 5.0;   // s
constexpr float kNoise = 1e-3f;  // m

std::vector<bool> pinned(const Scene& scene) {
  std::vector<bool> pinned(scene.cloth_info(0).particles);
  for (const uint32_t pin : scene.def().pins) pinned[pin] = true;
  return pinned;
}

void disturb(Scene& scene, uint32_t seed) {
  const std::vector<bool> fixed = pinned(scene);
  std::mt19937 random(seed);
  // Not std::uniform_real_distribution, whose numbers each library may choose.
  const auto noise = [&] { return kNoise * (2.0f * float(random() >> 8) / float(1 << 24) - 1.0f); };
  for (const pleat_cloth cloth : scene.cloths()) {
    const uint32_t count = uint32_t(fixed.size());
    std::vector<float> positions(3 * fixed.size()), velocities(positions.size());
    scene.check(scene.api().cloth_read_particles(scene.world(), cloth, positions.data(), velocities.data(), count),
                "start");
    for (size_t i = 0; i < positions.size(); ++i) {
      if (!fixed[i / 3]) positions[i] += noise();
    }
    scene.check(scene.api().cloth_write_particles(scene.world(), cloth, positions.data(), velocities.data(), count),
                "start");
  }
}

/// The largest motion of a free particle in a frame while the body is held, mm.
double watch_slips(Scene& scene) {
  const std::vector<bool> fixed = pinned(scene);
  std::vector<std::vector<float>> before(scene.cloths().size());
  std::vector<float> after;
  double largest2 = 0.0;
  for (size_t k = 0; k < before.size(); ++k) scene.read_particles(k, before[k]);
  for (long frame = 0; frame < std::lround(kWatch * scene.def().rate); ++frame) {
    scene.hold();
    for (size_t k = 0; k < before.size(); ++k) {
      scene.read_particles(k, after);
      for (size_t i = 0; i < fixed.size(); ++i) {
        if (fixed[i]) continue;
        double moved2 = 0.0;
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) moved2 += std::pow(double(after[c]) - double(before[k][c]), 2);
        largest2 = std::max(largest2, moved2);
      }
      before[k].swap(after);
    }
  }
  return 1000.0 * std::sqrt(largest2);
}

Start measure_start(const pleat_api& api, const demo::SceneDef& def, uint32_t number, demo::Progress& progress) {
  Scene scene(api, def);
  if (number > 0) disturb(scene, number);
  demo::SceneQuality quality(scene);
  std::vector<demo::DrawnSurface> surfaces;
  for (size_t k = 0; k < scene.cloths().size(); ++k) surfaces.push_back(demo::make_surface(scene, k));
  for (uint32_t frame = 0; frame < def.frames; ++frame) {
    scene.advance();
    for (size_t k = 0; k < surfaces.size(); ++k) demo::read_vertices(scene, k, surfaces[k]);
    quality.add_frame(scene, surfaces);
    progress.step();
  }
  quality.measure_rest(scene);
  Start start{number, quality.result(), {}};
  if (def.motion) start.late_slip_mm = watch_slips(scene);
  return start;
}

nlohmann::ordered_json figures(const Start& start) {
  const nlohmann::ordered_json all = demo::to_json(start.quality);
  nlohmann::ordered_json json;
  for (const char* name : {"rest_jitter_mm", "strain_max_percent", "penetration_particle_mm", "penetration_interior_mm",
                           "penetration_drawn_mm"}) {
    if (all.contains(name)) json[name] = all[name];
  }
  if (start.late_slip_mm) json["late_slip_mm"] = *start.late_slip_mm;
  return json;
}

}  // namespace

std::vector<Start> measure_starts(const pleat_api& api, const demo::SceneDef& def, uint32_t count) {
  demo::Progress progress("starts, frame", def.frames * count);
  std::vector<Start> starts;
  for (uint32_t number = 0; number < count; ++number) starts.push_back(measure_start(api, def, number, progress));
  return starts;
}

nlohmann::ordered_json starts_json(const std::vector<Start>& starts) {
  nlohmann::ordered_json runs = nlohmann::ordered_json::array(), worst = nlohmann::ordered_json::object();
  for (const Start& start : starts) {
    nlohmann::ordered_json run = {{"start", start.number}};
    const nlohmann::ordered_json of_start = figures(start);
    for (const auto& [name, value] : of_start.items()) {
      run[name] = value;
      worst[name] = std::max(value.get<double>(), worst.value(name, 0.0));
    }
    runs.push_back(std::move(run));
  }
  return {{"runs", runs}, {"worst", worst}};
}

void print_starts(const std::vector<Start>& starts) {
  const nlohmann::ordered_json json = starts_json(starts);
  std::printf("\n%-28s %10s %10s\n", "over all starts", "worst", "of start");
  for (const auto& worst : json["worst"].items()) {
    const auto& runs = json["runs"];
    const auto at = std::ranges::find_if(runs, [&](const auto& run) { return run.at(worst.key()) == worst.value(); });
    std::printf("  %-26s %10.4f %10u\n", worst.key().c_str(), worst.value().get<double>(),
                at->at("start").get<unsigned>());
  }
}

}  // namespace pleat::bench
