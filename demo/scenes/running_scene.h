#pragma once

#include <span>
#include <vector>

#include "demo/scenes/scene_def.h"

namespace pleat::demo {

/// A scene whose body moves frame by frame, whoever simulates the cloth. Frame f ends at (f + 1) / rate seconds.
class RunningScene {
 public:
  explicit RunningScene(SceneDef def);
  virtual ~RunningScene() = default;
  RunningScene(const RunningScene&) = delete;
  RunningScene& operator=(const RunningScene&) = delete;

  /// To the next frame: pose_next, then step.
  void advance();
  /// Finds where the body is at the end of the next frame. The host's work: not timed.
  void pose_next();
  /// A tick: writes the pins and the bodies, steps the cloth.
  virtual void step() = 0;
  /// A tick with the body as it is, after the last frame of interest.
  void hold() { step(); }

  const SceneDef& def() const { return def_; }
  size_t copies() const { return def_.origins.size(); }
  uint32_t frame() const { return frame_; }       ///< frames done
  const BodyPose& body() const { return body_; }  ///< now, of the copy at the world's origin
  /// Coarse particles of a copy's cloth, (P,3) m.
  virtual void read_particles(size_t copy, std::vector<float>& positions) const = 0;

 protected:
  /// Runs def().settle seconds up to frame 0, where something moves.
  void settle();
  /// The pins, (pins,3) m, of the copy at the origin. They keep their place in the hips frame.
  const std::vector<float>& pin_positions() const { return pin_positions_; }

 private:
  void pose_at(double seconds);

  SceneDef def_;
  BodyPose body_;
  Eigen::Isometry3d from_first_hips_ = Eigen::Isometry3d::Identity();  // world at the first pose -> hips frame
  std::vector<float> pin_positions_;
  uint32_t frame_ = 0;
};

/// All points of `positions` (N,3) moved by `offset`.
void move_points(std::span<const float> positions, const Eigen::Vector3d& offset, std::vector<float>& moved);

}  // namespace pleat::demo
