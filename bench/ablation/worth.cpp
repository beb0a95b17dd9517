#include "bench/ablation/worth.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <random>

#include "bench/host_frame.h"
#include "bench/metrics/surface_distance.h"
#include "demo/quality/scene_quality.h"
#include "demo/quality/scene_surface.h"
#include "demo/quality/surface_motion.h"

namespace pleat::bench {
namespace {

using demo::DrawnSurface;
using demo::Scene;
using demo::SceneDef;

constexpr size_t kSamples = 2000;  // of each surface: a distance to about 2 %

/// A way to run the scene, and what came of it.
struct Variant {
  SceneDef def;
  std::vector<std::vector<double>> times{};  // us, of each frame in each round
  Flaws flaws{};
  demo::TriangleMesh last{};  // as drawn
  uint32_t particles = 0;
};

/// All variants frame by frame in turn, so that a slow moment of the machine meets all alike; in a new order each
/// time, for who comes after its like finds the processor's caches and predictors warm. Where a scene lies in memory
/// matters too: so they are also made in an order of the round's own.
void time_round(const pleat_api& api, uint32_t round, std::vector<Variant>& variants) {
  struct Run {
    std::unique_ptr<Scene> scene;
    std::vector<DrawnSurface> surfaces;
  };
  std::vector<Run> runs(variants.size());
  std::vector<size_t> order(runs.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::mt19937 random(round);
  std::ranges::shuffle(order, random);
  for (const size_t k : order) {
    runs[k].scene = std::make_unique<Scene>(api, variants[k].def);
    runs[k].surfaces = make_surfaces(*runs[k].scene);
    variants[k].times.resize(variants[k].def.frames);
  }
  for (size_t frame = 0; frame < variants[0].times.size(); ++frame) {
    std::ranges::shuffle(order, random);
    for (const size_t k : order) {
      runs[k].scene->pose_next();
      const auto start = std::chrono::steady_clock::now();
      host_frame(*runs[k].scene, runs[k].surfaces);
      const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
      variants[k].times[frame].push_back(time.count());
    }
  }
}

/// The deepest of what was measured.
std::optional<double> deepest(const demo::Quality& quality) {
  return std::max({quality.penetration_particle_mm, quality.penetration_interior_mm, quality.penetration_drawn_mm});
}

void judge(const pleat_api& api, bool rest, Variant& variant) {
  Scene scene(api, variant.def);
  std::vector<DrawnSurface> surfaces = make_surfaces(scene);
  demo::SceneQuality meter(scene);
  demo::SurfaceMotionMeter drawn(demo::surface_mesh(api, variant.def));
  std::vector<float> particles;
  while (scene.frame() < variant.def.frames) {
    scene.pose_next();
    host_frame(scene, surfaces);
    meter.add_frame(scene, surfaces);
    scene.read_particles(0, particles);
    drawn.add_frame(particles, surfaces[0].vertices);
  }
  variant.particles = scene.cloth_info(0).particles;
  variant.last = {surfaces[0].positions(), {}, surfaces[0].indices};
  if (rest) meter.measure_rest(scene);
  const demo::Quality quality = meter.result();
  variant.flaws = {.stretch_percent = quality.strain_max_percent,
                   .inside_mm = deepest(quality),
                   .length_percent = drawn.result().length_rms_percent,
                   .crossings = quality.crossings_per_frame,
                   .jitter_mm = quality.rest_jitter_mm};
}

/// Of the least time of each frame: its work is the same in every round, all else is the machine.
double mean_frame(const Variant& variant) {
  double sum = 0.0;
  for (const std::vector<double>& times : variant.times) sum += *std::ranges::min_element(times);
  return sum / double(variant.times.size());
}

Worth compare(const Ablation& ablation, const Variant& with, const Variant& without) {
  const SurfaceDistance distance = surface_distance(with.last, without.last, kSamples);
  return {.ablation = ablation,
          .saved_us = mean_frame(with) - mean_frame(without),
          .with = with.flaws,
          .without = without.flaws,
          .apart_mm = 1e3 * distance.rms,
          .turned_deg = distance.normal_rms_deg};
}

}  // namespace

uint32_t worth_steps(uint32_t rounds) { return rounds + uint32_t(parts().size() + 1); }

SceneWorth measure_worth(const pleat_api& api, const demo::SceneDef& scene, uint32_t rounds, bool rest,
                         const std::function<void()>& step) {
  std::vector<Ablation> ablations;
  std::vector<Variant> variants = {{scene}};  // as it is, then the other side of each ablation
  for (const Part& part : parts()) {
    ablations.push_back(ablate(scene, part));
    variants.push_back({scene});
    variants.back().def.settings = ablations.back().put_in ? ablations.back().with : ablations.back().without;
  }
  for (uint32_t round = 0; round < rounds; ++round) {
    time_round(api, round, variants);
    step();
  }
  for (Variant& variant : variants) {
    judge(api, rest, variant);
    step();
  }
  const Variant& as_is = variants[0];
  SceneWorth worth{scene.name, as_is.particles, rounds, mean_frame(as_is), as_is.flaws, {}};
  for (size_t k = 0; k < ablations.size(); ++k) {
    const Variant& other = variants[k + 1];
    worth.parts.push_back(ablations[k].put_in ? compare(ablations[k], other, as_is)
                                              : compare(ablations[k], as_is, other));
  }
  return worth;
}

}  // namespace pleat::bench
