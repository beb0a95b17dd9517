#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/bullet_scene.h"
#include "bench/error/rest_scene.h"
#include "demo/scenes/drawn_surface.h"
#include "demo/scenes/scene.h"

namespace pleat::bench {

inline constexpr double kFrame = 1.0 / 60.0;  ///< s, the frame that costs are of

/// How the particles of a rest scene are moved.
struct Dynamics {
  std::string name;
  Grid grid;
  pleat_cloth_settings settings;
  std::optional<BulletSettings> peer;  ///< moved by Bullet, with the thickness and the air damping of `settings`
  uint32_t ticks = 1;                  ///< a frame
};

/// What is drawn over them.
struct Drawing {
  std::string method;       ///< what a curve of the chart is drawn through
  uint32_t surface, level;  ///< PLEAT_SURFACE_*; a peer draws its bare particles
  uint32_t fold_sweeps = 0;
};

/// A rest scene that is simulated in one way.
class Contestant {
 public:
  /// Its particles are where the scene starts.
  Contestant(const pleat_api& api, const RestScene& scene, const Dynamics& dynamics);

  /// At once and from now on.
  void draw_as(const Drawing& drawing);
  /// Ours only: every particle to its place, (P,3) m, at rest, and drawn there.
  void place(std::span<const float> positions);
  /// What a host does in a frame: steps, then reads what is drawn.
  void run_frame();
  /// As of the last frame.
  demo::TriangleMesh surface() const;
  std::vector<float> particles() const;
  /// As it was cut.
  const demo::TriangleMesh& garment() const { return running().def().garment; }

 private:
  const demo::RunningScene& running() const;

  std::unique_ptr<demo::Scene> ours_;
  std::unique_ptr<BulletScene> peer_;
  uint32_t ticks_;
  demo::DrawnSurface drawn_;  // of ours
  std::vector<float> bare_;   // of the peer: (P,3) m
};

inline constexpr int kSettleFrames = 300;  // of 1/60 s
/// Runs for 5 s, in which all of these scenes come to rest.
void settle(Contestant& contestant);

}  // namespace pleat::bench
