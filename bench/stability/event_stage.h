// What an event happens to, and what is seen of it from outside.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/stability/edges.h"
#include "bench/validation/rig.h"
#include "engine/pleat.h"

namespace pleat::bench {

struct EventResult {
  std::string name;
  std::string outcome;                           ///< recovered, repaired (the mesh), refused, or failed
  std::string said;                              ///< the library's last line
  double peak_strain = 0.0, final_strain = 0.0;  ///< largest elongation of an edge, ever and in the end, fraction
  uint64_t nonfinite_out = 0;                    ///< numbers that came out, particles' and drawn ones
  std::optional<double> jitter_mm, drift_mm;     ///< of a cloth at rest, see EventStage::watch_rest
  std::vector<std::pair<std::string_view, uint64_t>> interventions;  ///< of pleat_stats, those that are not 0
};

/// A cloth that ticks while everything that comes out of it is looked at. Throws as Rig.
class EventStage {
 public:
  static constexpr double kTick = 1.0 / 60.0;  // s

  EventStage(const pleat_api& api, const RigDef& def);

  void run(double seconds, double dt = kTick);
  void tick(double dt = kTick);
  /// Where the pins are at the end of the next tick, (pins,3) m.
  std::vector<float> pins;
  void move_pins();
  pleat_collider add_capsule(std::array<float, 3> a, std::array<float, 3> b, float radius);
  /// The call has to be refused, with a line that names the field.
  void expect_refusal(pleat_result result, std::string_view field);
  /// Root mean square of the free particles' motion in a frame, and how far one of them is from where it was.
  void watch_rest(long ticks);
  EventResult finish();

  const pleat_api& api;
  Rig rig;

 private:
  void look();

  Edges edges_;
  std::vector<float> drawn_;
  pleat_vertex_target target_;
  EventResult result_;
};

}  // namespace pleat::bench
