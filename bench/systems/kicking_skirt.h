// The skirt that the systems are timed on, at any density.
#pragma once

#include <cstdint>
#include <numbers>

#include "bench/systems/arena.h"
#include "engine/world.h"

namespace pleat::bench {

struct SkirtSize {
  uint32_t rings, columns;
  uint32_t particles() const { return rings * columns; }
};
inline constexpr SkirtSize kSkirtSizes[] = {{6, 11}, {12, 22}, {24, 44}};

/// A tube of cloth from the waist to the knees with default settings, over hips and legs of five capsules; one leg
/// kicks, as in the scene skirt_kick. Behind the C interface, with its world in an arena.
class KickingSkirt {
 public:
  /// `stage` is called as pleat_world_def says. Throws std::runtime_error where the library refuses something.
  KickingSkirt(SkirtSize size, pleat_stage_fn stage = nullptr, void* stage_user = nullptr);
  ~KickingSkirt();
  KickingSkirt(const KickingSkirt&) = delete;
  KickingSkirt& operator=(const KickingSkirt&) = delete;

  void tick();
  Arena& arena() { return arena_; }
  World& world() { return *reinterpret_cast<World*>(world_); }
  static constexpr float kTick = 1.0f / 30.0f;  // s

 private:
  void make_cloth(SkirtSize size);
  void move_leg(float angle);

  Arena arena_;
  pleat_world* world_ = nullptr;
  pleat_collider thigh_{}, calf_{};
  float time_ = 0.0f;  // s
};

}  // namespace pleat::bench
