#include "bench/error/contestant.h"

#include <utility>

namespace pleat::bench {

Contestant::Contestant(const pleat_api& api, const RestScene& scene, const Dynamics& dynamics)
    : ticks_(dynamics.ticks) {
  demo::SceneDef def = rest_scene_def(api, scene, dynamics.grid, dynamics.settings, dynamics.ticks / kFrame);
  const std::vector<float> start = start_positions(scene, dynamics.grid);
  if (dynamics.peer) {
    peer_ = std::make_unique<BulletScene>(std::move(def), *dynamics.peer);
    peer_->write_particles(0, start);
    return;
  }
  ours_ = std::make_unique<demo::Scene>(api, std::move(def));
  drawn_ = demo::make_surface(*ours_, 0);
  place(start);
}

void Contestant::place(std::span<const float> positions) {
  ours_->check(ours_->api().cloth_write_particles(ours_->world(), ours_->cloths()[0], positions.data(), nullptr,
                                                  uint32_t(positions.size() / 3)),
               "particles");
  demo::read_vertices(*ours_, 0, drawn_);
}

const demo::RunningScene& Contestant::running() const {
  return ours_ ? static_cast<const demo::RunningScene&>(*ours_) : *peer_;
}

void Contestant::draw_as(const Drawing& drawing) {
  if (!ours_) return;
  pleat_cloth_settings settings{};
  settings.size = sizeof settings;
  const pleat_cloth cloth = ours_->cloths()[0];
  ours_->check(ours_->api().cloth_get(ours_->world(), cloth, &settings), "settings");
  settings.surface = drawing.surface;
  settings.level = drawing.level;
  settings.fold_sweeps = drawing.fold_sweeps;
  ours_->check(ours_->api().cloth_set(ours_->world(), cloth, &settings), "surface");
  drawn_ = demo::make_surface(*ours_, 0);
  demo::read_vertices(*ours_, 0, drawn_);
}

void Contestant::run_frame() {
  for (uint32_t tick = 0; tick < ticks_; ++tick) {
    if (ours_) {
      ours_->step();
    } else {
      peer_->step();
    }
  }
  if (ours_) {
    demo::read_vertices(*ours_, 0, drawn_);
  } else {
    peer_->read_particles(0, bare_);
  }
}

std::vector<float> Contestant::particles() const {
  std::vector<float> positions;
  running().read_particles(0, positions);
  return positions;
}

demo::TriangleMesh Contestant::surface() const {
  demo::TriangleMesh mesh;
  mesh.positions = ours_ ? drawn_.positions() : bare_;
  mesh.triangles = ours_ ? drawn_.indices : running().def().garment.triangles;
  return mesh;
}

void settle(Contestant& contestant) {
  for (int frame = 0; frame < kSettleFrames; ++frame) contestant.run_frame();
}

}  // namespace pleat::bench
