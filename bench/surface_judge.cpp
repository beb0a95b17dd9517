#include "bench/surface_judge.h"

#include <cmath>
#include <deque>

#include "bench/metrics/size_error.h"
#include "demo/quality/solid_mesh.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"
#include "demo/scenes/stage_clock.h"

namespace pleat::bench {
namespace {

constexpr int kRounds = 50;  // of timing

demo::Vector3d point(std::span<const float> positions, size_t i) {
  return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

/// A cloth that is placed anew again and again and draws itself each time: the library has no other work here, so what
/// its stages take is the surface's cost.
class Drawing {
 public:
  Drawing(const pleat_api& api, const SurfaceTruth& truth, uint32_t n, const pleat_cloth_settings& settings)
      : particles_(every(truth.positions, kFineSide, (kFineSide - 1) / (n - 1))),
        scene_(api, scene_def(api, truth, n, settings, particles_), demo::StageClock::on_stage, &clock_) {}

  void draw() {
    clock_.begin_frame();
    scene_.check(scene_.api().cloth_write_particles(scene_.world(), scene_.cloths()[0], particles_.data(), nullptr,
                                                    uint32_t(particles_.size() / 3)),
                 "particles");
    clock_.end_frame();
  }
  demo::DrawnSurface surface() const {
    demo::DrawnSurface surface = demo::make_surface(scene_, 0);
    demo::read_vertices(scene_, 0, surface);
    return surface;
  }
  double us() const {
    double sum = 0.0;
    for (const demo::StageClock::Stage& stage : clock_.stages()) sum += demo::spread_of(stage.frames).median;
    return sum;
  }

 private:
  static demo::SceneDef scene_def(const pleat_api& api, const SurfaceTruth& truth, uint32_t n,
                                  const pleat_cloth_settings& settings, const std::vector<float>& particles) {
    demo::SceneDef def;
    def.name = truth.name;
    def.settings = settings;
    def.garment = flat_square(api, n);
    if (!truth.flat_at_rest) def.garment.positions = particles;
    return def;
  }

  std::vector<float> particles_;
  demo::StageClock clock_;
  demo::Scene scene_;
};

}  // namespace

double rms_distance(std::span<const float> points, std::span<const float> positions,
                    std::span<const uint32_t> triangles) {
  const demo::SolidMesh mesh(positions, triangles);
  double sum = 0.0;
  for (size_t i = 0; i < points.size() / 3; ++i) {
    const double distance = mesh.signed_distance(point(points, i));
    sum += distance * distance;
  }
  return std::sqrt(sum / double(points.size() / 3));
}

std::vector<SurfaceVerdict> judge(const pleat_api& api, const SurfaceTruth& truth, uint32_t n,
                                  std::span<const uint32_t> modes, const pleat_cloth_settings& settings) {
  std::deque<Drawing> drawings;  // a drawing stays where it was made: its scene calls its clock
  for (const uint32_t mode : modes) {
    pleat_cloth_settings own = settings;
    own.surface = mode;
    drawings.emplace_back(api, truth, n, own);
  }
  for (int round = 0; round < kRounds; ++round) {
    for (Drawing& drawing : drawings) drawing.draw();
  }
  const double true_area = mesh_area(truth.positions, flat_square(api, kFineSide).triangles);
  std::vector<SurfaceVerdict> verdicts;
  for (const Drawing& drawing : drawings) {
    const demo::DrawnSurface drawn = drawing.surface();
    const std::vector<float> positions = drawn.positions();
    verdicts.push_back({1e3 * rms_distance(truth.positions, positions, drawn.indices),
                        100.0 * (mesh_area(positions, drawn.indices) / true_area - 1.0), drawing.us()});
  }
  return verdicts;
}

}  // namespace pleat::bench
