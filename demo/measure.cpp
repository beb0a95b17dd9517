#include "demo/measure.h"

#include <algorithm>
#include <cmath>

#include "demo/program/progress.h"
#include "demo/quality/scene_quality.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"
#include "demo/view.h"

namespace pleat::demo {
namespace {

using Eigen::Vector3d;

Vector3d point(std::span<const float> positions, size_t index) {
  return {positions[3 * index], positions[3 * index + 1], positions[3 * index + 2]};
}

/// Finds the frame in which a cloth's edges are most compressed.
class CompressionWatch {
 public:
  explicit CompressionWatch(const Scene& scene, uint32_t edges) : edges_(2 * size_t(edges)), rest_lengths_(edges) {
    scene.check(
        scene.api().garment_read_edges(scene.world(), scene.garment(), edges_.data(), rest_lengths_.data(), edges),
        "edges");
  }

  void add_frame(uint32_t frame, std::span<const float> particles) {
    double sum = 0.0;
    for (size_t e = 0; e < rest_lengths_.size(); ++e) {
      const double length = (point(particles, edges_[2 * e + 1]) - point(particles, edges_[2 * e])).norm();
      const double shortening = std::max(0.0, 1.0 - length / double(rest_lengths_[e]));
      sum += shortening * shortening;
    }
    if (sum <= most_) return;
    most_ = sum;
    frame_ = frame;
  }

  uint32_t frame() const { return frame_; }

 private:
  std::vector<uint32_t> edges_;
  std::vector<float> rest_lengths_;
  double most_ = 0.0;
  uint32_t frame_ = 1;
};

/// A border edge of the garment is drawn as this many.
size_t segments_of_edge(const pleat_cloth_settings& settings) {
  return settings.level == PLEAT_LEVEL_FAN ? 4 : 2 * size_t(settings.level);
}

}  // namespace

RunRecord measure(const pleat_api& api, const SceneDef& def) {
  StageClock clock;
  Scene scene(api, def, StageClock::on_stage, &clock);
  RunRecord record{};
  record.garment.size = sizeof record.garment;
  scene.check(api.garment_info(scene.world(), scene.garment(), &record.garment), "garment");
  record.cloths = scene.cloths().size();

  std::vector<DrawnSurface> surfaces;
  for (size_t k = 0; k < record.cloths; ++k) surfaces.push_back(make_surface(scene, k));
  const SurfaceTopology topology = inspect_topology(surfaces[0].indices);
  record.border_edges = topology.border_edges;
  record.watertight =
      topology.manifold && topology.border_edges == record.garment.border_edges * segments_of_edge(def.settings);

  SceneQuality quality(scene);
  CompressionWatch compression(scene, record.garment.edges);
  std::vector<float> particles;
  record.all_finite = true;
  Progress progress("simulating, frame", def.frames);
  for (uint32_t frame = 1; frame <= def.frames; ++frame) {
    clock.begin_frame();
    scene.advance();
    clock.end_frame();
    record.seen.extend(cloth_box(scene));
    for (size_t k = 0; k < record.cloths; ++k) {
      read_vertices(scene, k, surfaces[k]);
      record.all_finite = record.all_finite && all_finite(surfaces[k]);
    }
    scene.read_particles(0, particles);
    compression.add_frame(frame, particles);
    quality.add_frame(scene, surfaces);
    progress.step();
  }
  record.most_compressed_frame = compression.frame();
  record.cloth = scene.cloth_info(0);
  record.stats.size = sizeof record.stats;
  scene.check(api.world_stats(scene.world(), &record.stats), "statistics");
  quality.measure_rest(scene);
  record.quality = quality.result();
  record.stages = clock.stages();
  return record;
}

}  // namespace pleat::demo
