#pragma once

#include <array>
#include <string>
#include <vector>

#include "demo/scenes/triangle_mesh.h"
#include "engine/pleat.h"

namespace pleat::bench {

using Point = std::array<double, 3>;

/// Settings of which nothing is left but the masses: no spring, no bending, no damping, no strain limit, one substep a
/// tick, drawn flat. A case switches on what it is about.
pleat_cloth_settings bare_settings(const pleat_api& api);

struct RigDef {
  demo::TriangleMesh mesh;  ///< at rest, m
  std::vector<uint32_t> pins;
  std::vector<float> added_mass;    ///< kg a particle, or empty
  std::vector<float> start;         ///< (P,3) m; empty: the rest shape
  std::vector<float> start_motion;  ///< (P,3) m/s; empty: at rest
  std::array<float, 3> gravity{0.0f, -9.81f, 0.0f};
  pleat_cloth_settings settings;
  demo::TriangleMesh body;  ///< stands still; empty: none
};

/// One piece of cloth in a world of its own, through the C interface. Throws std::runtime_error where that refuses.
class Rig {
 public:
  Rig(const pleat_api& api, const RigDef& def);
  ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// `ticks` ticks of `dt` s.
  void step(double dt, int ticks = 1);
  uint32_t count() const { return uint32_t(state_.size() / 6); }
  /// As of the last step.
  Point position(uint32_t particle) const { return point(particle); }
  Point velocity(uint32_t particle) const { return point(count() + particle); }

  pleat_world* world() const { return world_; }
  pleat_garment garment() const { return garment_; }
  pleat_cloth cloth() const { return cloth_; }
  const pleat_mesh_report& report() const { return report_; }
  /// The library's last line; empty where it had nothing to say.
  const std::string& complaint() const { return complaint_; }
  void need(pleat_result result, const char* what) const;

 private:
  void create(const RigDef& def);
  void read();
  static void keep_log(uint32_t level, const char* line, void* user);
  Point point(uint32_t i) const { return {state_[3 * i], state_[3 * i + 1], state_[3 * i + 2]}; }

  const pleat_api& api_;
  pleat_world* world_ = nullptr;
  pleat_garment garment_{};
  pleat_cloth cloth_{};
  pleat_mesh_report report_{};
  std::vector<float> state_;  // positions, then velocities
  std::string complaint_;     // the engine's last line
};

}  // namespace pleat::bench
