#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "demo/scenes/running_scene.h"

namespace pleat::bench {

/// What decides how long Bullet's soft body takes, and how well it holds.
struct BulletSettings {
  int iterations = 4;        ///< of positions, a step
  double voxel_size = 0.25;  ///< m, of the distance field that particles are tested in; Bullet's default
  double stiffness =
      1.0;               ///< of links, 0..1: the share of a link's error that an iteration takes back; Bullet's default
  double bending = 0.0;  ///< the same of links over two edges, which resist bending; 0: none
  double hardness = 0.1;  ///< share of a particle's depth in a body that is taken back, a step; Bullet's default
};

/// A scene run by Bullet's soft body (btSoftBody), the peer of `frame_budget`: the same particles, edges, mass, pins,
/// friction, damping and thickness, one step a frame. No bending, wind, tethers or contact of faces.
class BulletScene final : public demo::RunningScene {
 public:
  /// Throws InputError for a scene with bodies other than capsules and tapered capsules.
  BulletScene(demo::SceneDef scene_def, const BulletSettings& settings);
  ~BulletScene() override;

  void step() override;
  /// Every particle of a copy to its place, (P,3) m, at rest; pins too.
  void write_particles(size_t copy, std::span<const float> positions);
  void read_particles(size_t copy, std::vector<float>& positions) const override;

  static std::string version();  ///< "3.24"

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace pleat::bench
