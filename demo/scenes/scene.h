#pragma once

#include <span>
#include <string>
#include <vector>

#include "demo/scenes/running_scene.h"
#include "engine/pleat.h"

namespace pleat::demo {

/// A scene that pleat runs: a world with its cloths and bodies, one tick a frame.
class Scene final : public RunningScene {
 public:
  /// `stage` may be null: see pleat_world_def. Runs def.settle seconds up to frame 0.
  /// Throws InputError where the engine refuses what the scene asks for, std::runtime_error for a fault of ours.
  Scene(const pleat_api& api, SceneDef def, pleat_stage_fn stage = nullptr, void* stage_user = nullptr);
  ~Scene() override;

  void step() override;
  void read_particles(size_t cloth, std::vector<float>& positions) const override;

  const pleat_api& api() const { return api_; }
  pleat_world* world() const { return world_; }
  pleat_garment garment() const { return garment_; }
  std::span<const pleat_cloth> cloths() const { return cloths_; }
  pleat_cloth_info cloth_info(size_t cloth) const;
  pleat_stats stats() const;

  /// Turns the engine's complaint into an exception.
  void check(pleat_result result, const char* what) const;

 private:
  void create_garment();
  void create_copies();
  void create_fixed_bodies();
  pleat_collider create_collider(const pleat_collider_def& def);
  static void keep_log(uint32_t level, const char* line, void* user);

  const pleat_api& api_;
  pleat_world* world_ = nullptr;
  pleat_garment garment_{};
  std::vector<pleat_cloth> cloths_;         // one a copy
  std::vector<pleat_collider> meshes_;      // a copy each, where the body is a mesh
  std::vector<pleat_collider> body_parts_;  // copy by copy, in BodyPose's order
  std::vector<float> moved_;                // scratch: of one copy
  std::string complaint_;                   // the engine's last error line
};

}  // namespace pleat::demo
