#include "bench/scaling/growth.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <string_view>

#include "bench/host_frame.h"
#include "demo/scenes/scene_reader.h"

namespace pleat::bench {
namespace {

constexpr double kSeconds = 0.5;

double longest_edge(const demo::Scene& scene) {
  const pleat_api& api = scene.api();
  pleat_garment_info info{};
  info.size = sizeof info;
  scene.check(api.garment_info(scene.world(), scene.garment(), &info), "garment");
  std::vector<uint32_t> ends(2 * size_t(info.edges));
  std::vector<float> rest(info.edges), x;
  scene.check(api.garment_read_edges(scene.world(), scene.garment(), ends.data(), rest.data(), info.edges), "edges");
  double most = -1.0;
  for (size_t k = 0; k < scene.cloths().size(); ++k) {
    scene.read_particles(k, x);
    for (size_t e = 0; e < rest.size(); ++e) {
      const float *a = &x[3 * size_t(ends[2 * e])], *b = &x[3 * size_t(ends[2 * e + 1])];
      most = std::max(most, double(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / rest[e] - 1.0f));
    }
  }
  return 100.0 * most;
}

void count_pass(const char* system, int begin, void* passes) {
  if (begin != 0 && std::string_view(system) == "stretch_constraint") ++*static_cast<uint64_t*>(passes);
}

/// One run. Keeps the least processor time of each frame, us; the rest is the same in each run.
void run_once(const pleat_api& api, const demo::SceneDef& def, std::vector<double>& least, SizeCost& cost) {
  uint64_t passes = 0;
  demo::Scene scene(api, def, count_pass, &passes);
  std::vector<demo::DrawnSurface> surfaces = make_surfaces(scene);
  least.resize(def.frames, HUGE_VAL);
  for (double& us : least) {
    scene.pose_next();
    passes = 0;
    const std::clock_t start = std::clock();
    host_frame(scene, surfaces);
    us = std::min(us, 1e6 * double(std::clock() - start) / CLOCKS_PER_SEC);
  }
  cost.particles = scene.cloth_info(0).particles * scene.cloths().size();
  cost.substeps = scene.cloth_info(0).substeps;
  cost.passes = passes / scene.cloths().size();
  cost.longest_edge = longest_edge(scene);
}

}  // namespace

Growth measure_growth(const pleat_api& api, const std::string& scene, const std::vector<uint32_t>& sizes,
                      uint32_t rounds, const std::function<void()>& progress) {
  Growth growth{scene, {}};
  std::vector<demo::SceneDef> defs;
  for (const uint32_t size : sizes) {
    demo::SceneRequest request;
    request.scene = scene + ":" + std::to_string(size);
    demo::SceneDef def = demo::load_scene(api, request);
    def.frames = uint32_t(kSeconds * def.rate);
    defs.push_back(std::move(def));
    growth.sizes.push_back({.size = size, .particles = 0});
  }
  std::vector<std::vector<double>> least(sizes.size());
  for (uint32_t round = 0; round < rounds; ++round) {
    for (size_t k = 0; k < defs.size(); ++k) {
      run_once(api, defs[k], least[k], growth.sizes[k]);
      progress();
    }
  }
  for (size_t k = 0; k < defs.size(); ++k) {
    growth.sizes[k].us = std::accumulate(least[k].begin(), least[k].end(), 0.0) / double(least[k].size());
  }
  return growth;
}

}  // namespace pleat::bench
