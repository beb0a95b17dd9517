#pragma once

#include <span>
#include <string>
#include <vector>

#include "demo/scenes/scene_def.h"
#include "engine/pleat.h"

namespace pleat::demo {

/// A scene that runs: a world with its cloths and bodies, one tick a frame. Frame f ends at (f + 1) / rate seconds.
class Scene {
 public:
  /// `stage` may be null: see pleat_world_def. Runs def.settle seconds up to frame 0.
  /// Throws InputError where the engine refuses what the scene asks for, std::runtime_error for a fault of ours.
  Scene(const pleat_api& api, SceneDef def, pleat_stage_fn stage = nullptr, void* stage_user = nullptr);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// To the next frame: pose_next, then step.
  void advance();
  /// Finds where the body is at the end of the next frame. The host's work: not timed.
  void pose_next();
  /// A tick: writes the pins and the bodies, steps the world.
  void step();
  /// A tick with the body as it is, after the last frame of interest.
  void hold() { step(); }

  const pleat_api& api() const { return api_; }
  const SceneDef& def() const { return def_; }
  pleat_world* world() const { return world_; }
  pleat_garment garment() const { return garment_; }
  std::span<const pleat_cloth> cloths() const { return cloths_; }
  uint32_t frame() const { return frame_; }       ///< frames done
  const BodyPose& body() const { return body_; }  ///< now, of the copy at the world's origin
  pleat_cloth_info cloth_info(size_t cloth) const;
  /// Coarse particles of a cloth, (P,3) m.
  void read_particles(size_t cloth, std::vector<float>& positions) const;

  /// Turns the engine's complaint into an exception.
  void check(pleat_result result, const char* what) const;

 private:
  void create_garment();
  void create_copies();
  void create_fixed_bodies();
  pleat_collider create_collider(const pleat_collider_def& def);
  void place_pins();
  static void keep_log(uint32_t level, const char* line, void* user);

  const pleat_api& api_;
  SceneDef def_;
  pleat_world* world_ = nullptr;
  pleat_garment garment_{};
  std::vector<pleat_cloth> cloths_;         // one a copy
  std::vector<pleat_collider> meshes_;      // a copy each, where the body is a mesh
  std::vector<pleat_collider> body_parts_;  // copy by copy, in BodyPose's order
  BodyPose body_;
  Eigen::Isometry3d from_first_hips_;  // world at the first pose -> hips frame
  std::vector<float> pin_positions_;   // of the copy at the origin
  std::vector<float> moved_;           // scratch: of one copy
  uint32_t frame_ = 0;
  std::string complaint_;  // the engine's last error line
};

}  // namespace pleat::demo
