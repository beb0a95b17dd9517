// A row of the schedule, and what a system gets to work on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "components/edge_law.h"
#include "engine/world.h"
#include "systems/box.h"
#include "systems/layer_candidates.h"

namespace pleat {

enum class Phase : std::uint32_t {
  kFrameBegin,
  kSubstepBegin,
  kStage,
  kContact,
  kSweep,
  kFriction,
  kSubstepEnd,
  kCheck,
  kFrameEnd,
  kCarried
};
inline constexpr std::size_t kPhases = static_cast<std::size_t>(Phase::kCarried) + 1;

/// Of a substep's sweeps, the last: they go over the edges alone and pull no farther than their rest lengths.
inline constexpr std::uint32_t kExactSweeps = 3;

/// One cloth during one tick: the views of its ranges, and where in the tick it is.
struct ClothTick {
  World& world;
  Worker& worker;
  ClothRecord& cloth;
  const Garment& garment;
  const pleat_cloth_settings& settings;

  float dt = 0.0f;                 // s, of the present substep
  float force_dt = 0.0f;           // s, of the steps in it in which forces act
  float t0 = 0.0f, t1 = 1.0f;      // the present substep's begin and end as fractions of the tick
  float spring_room = 0.0f;        // 1/s2, the largest omega^2 of springs that the present substep carries
  float frame_dt = 0.0f;           // s, of the tick; 0 when the surface is brought up to date between ticks
  std::uint32_t substeps = 1;      // of the tick
  std::uint32_t force_steps = 1;   // of each
  float capsule_margin = 0.0f;     // m, of the present substep, where there are capsules
  std::uint32_t bending_held = 1;  // substeps for which a force of bending acts
  std::uint32_t sweeps_left = 0;   // of the present substep, the present one included
  int stage = 0;                   // of the integrator
  std::uint32_t cloth_rows = 0;    // of contact: the first ones, with the cloth itself and with layers
  bool trouble = false;            // the tick has gone wrong
  bool loose = false;              // a start that is stretched
  bool deep = false;               // a start inside a body, which it is coming out of
  Box capsules_sought;             // in which the worker's capsules are all that there are in this tick
  LayersAround layers_around;      // in this tick
  RigidMotion carry;               // of the pins, in a tick that the cloth does without
  double time = 0.0;               // s, when the present substep begins
  Vec3 air;                        // m/s, velocity of the air now

  Vec3View position, velocity, force, previous, predicted;
  Vec3View start, start_velocity;  // as the tick began
  const float* inverse_mass;
  const float* mass;
  ConstVec3View pin_previous, pin_next;
  Vec3View normal, fold, drawn_position, drawn_normal, drawn_tangent;  // null where no cloth needs them
  float *fold_height = nullptr, *fold_side = nullptr, *drawn_handedness = nullptr;

  ClothTick(World& w, Worker& scratch, ClothRecord& c);
  EdgeLaw edge_law() const { return {.stiffness = settings.stiffness, .buckling = settings.buckling_strain}; }
};

struct Row {
  Phase phase;
  const char* name;
  /// Null where the cloth needs the system; else why it does not.
  const char* (*left_out)(const World&, const ClothRecord&);
  void (*run)(ClothTick&);
};

/// The table in three parts, by what they are about and in the order in which they run.
std::span<const Row> force_rows();
std::span<const Row> constraint_rows();
std::span<const Row> surface_rows();

/// All systems of this build, in the order in which they run.
std::span<const Row> schedule_table();
/// Those of a phase, a bit for each as in a Plan.
Plan rows_of(Phase phase);

}  // namespace pleat
