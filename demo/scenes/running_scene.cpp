#include "demo/scenes/running_scene.h"

#include <cmath>
#include <utility>

namespace pleat::demo {

RunningScene::RunningScene(SceneDef def) : def_(std::move(def)) {
  if (def_.motion) from_first_hips_ = def_.motion(-def_.settle).hips.inverse();
  pose_at(-def_.settle);
}

void RunningScene::pose_at(double seconds) {
  if (def_.motion) body_ = def_.motion(seconds);
  const Eigen::Isometry3d moved = body_.hips * from_first_hips_;
  pin_positions_.resize(3 * def_.pins.size());
  for (size_t i = 0; i < def_.pins.size(); ++i) {
    const float* rest = &def_.garment.positions[3 * size_t(def_.pins[i])];
    const Eigen::Vector3d now = moved * Eigen::Vector3d(rest[0], rest[1], rest[2]);
    for (size_t axis = 0; axis < 3; ++axis) pin_positions_[3 * i + axis] = float(now[Eigen::Index(axis)]);
  }
}

void RunningScene::settle() {
  const long ticks = def_.motion ? std::lround(def_.settle * def_.rate) : 0;
  for (long tick = 1; tick <= ticks; ++tick) {
    pose_at(double(tick - ticks) / def_.rate);
    step();
  }
}

void RunningScene::pose_next() {
  ++frame_;
  if (def_.motion) pose_at(double(frame_) / def_.rate);
}

void RunningScene::advance() {
  pose_next();
  step();
}

void move_points(std::span<const float> positions, const Eigen::Vector3d& offset, std::vector<float>& moved) {
  moved.resize(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) moved[i] = float(positions[i] + offset[Eigen::Index(i % 3)]);
}

}  // namespace pleat::demo
