// Everything a world holds: garments, cloths and colliders by handle, their state in flat columns, host services.
//
// A cloth is a record of ranges into the columns. Ranges start at multiples of the column padding and lie in the order
// in which the cloths were made; destroying one closes its gap.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/colliders.h"
#include "components/detail.h"
#include "components/frequency_rates.h"
#include "components/garment.h"
#include "components/near_pairs.h"
#include "components/particles.h"
#include "components/surface.h"
#include "components/tessellation_pattern.h"
#include "engine/jobs.h"
#include "engine/memory.h"
#include "engine/pleat.h"
#include "engine/registry.h"
#include "engine/worker.h"
#include "systems/implicit_solver.h"

namespace pleat {

class CollisionBodies;

inline constexpr std::uint32_t kLevelCount = PLEAT_LEVEL_MAX + 1;

/// A garment and the tessellation patterns that its cloths have asked for.
struct GarmentRecord {
  Garment garment;
  std::array<std::optional<TessellationPattern>, kLevelCount> patterns;
  std::vector<std::unique_ptr<ImplicitMatrix>> implicit;  // one a worker, where a cloth integrates by implicit Euler
  std::uint32_t users = 0;                                // cloths cut from it

  explicit GarmentRecord(Garment&& g) : garment(std::move(g)) {}
};

/// Of one cloth in its last tick, see Stats.
struct ContactCounts {
  std::uint64_t particle = 0, face = 0, self = 0, dropped = 0;
};

/// A line for the log that a worker leaves to the thread that steps the world, which says it once.
enum class Notice : std::uint8_t { kNothing, kDue, kSaid };

/// Which rows of the schedule a cloth runs: bit i is row i.
using Plan = std::uint64_t;

/// For how long a start that is stretched or inside a body is held at rest at most, s.
inline constexpr float kSettling = 0.25f;

/// In which a cloth finds its shape before it may wait, s.
inline constexpr float kYoung = 2.0f;
/// Of its `travelled`: it takes the next tick.
inline constexpr float kDue = 2.0f;

struct ClothRecord {
  GarmentRecord* source = nullptr;
  pleat_cloth_settings settings{};
  std::uint32_t particle_begin = 0, pin_begin = 0, normal_begin = 0, edge_begin = 0, drawn_begin = 0;
  Vec3 origin;  // m in the world, of its positions and pins; origin.h
  std::uint32_t substeps_taken = 0;
  ContactCounts contacts;
  std::uint32_t self_pair_count = kNone, layer_pair_count = kNone;  // none were sought yet
  LayersSought layers_sought;                                       // the latter
  Plan plan = 0;
  FrequencyRates rates;  // of these masses
  Notice lowered = Notice::kNothing, fallback = Notice::kNothing;
  std::uint32_t lowered_at = 0;       // substeps with which the stiffness was lowered
  bool said_jump = false;             // that its pins jumped
  Vec3 pin_velocity;                  // m/s, mean of the last tick
  bool visible = true;                // somebody sees it
  float importance = 1.0f;            // the host's, against other cloths; budget.h
  std::uint32_t given_up = 0;         // steps of detail
  float fold_share = 1.0f;            // of their height, with which folds are drawn
  bool sides_known = false;           // to which folds went when they were last drawn
  float substep_share = 1.0f;         // that is taken of those wanted
  bool carried = false;               // in the last tick, which it did without; within a tick, whether it may: turns.h
  float travelled = 0.0f;             // by bodies against it since it took one, of what they may; kDue: as far as that
  float young = kYoung;               // s, for how much longer it takes every tick
  std::uint32_t substeps_wanted = 0;  // in the last tick, with nothing given up
  float bending_left = 0.0f;          // s, for how much longer its force of bending is held
  float calm = 0.0f;                  // s, since when nothing has moved; sleep.h
  float settling = kSettling;         // s, for how much longer a start that does not fit is held back
  std::optional<RigidMotion> declared_jump;  // the host's, for the next tick
  bool pins_told = false;                    // where they shall be at its end
  std::uint64_t last_tick = 0;               // `ticks` of the world when it last ran

  const Garment& garment() const { return source->garment; }
  /// Null where smoothing is compiled out.
  const TessellationPattern* pattern() const {
    const auto& pattern = source->patterns[settings.level];
    return pattern ? &*pattern : nullptr;
  }
};

inline bool resists_bending(const ClothRecord& cloth) {
  return cloth.settings.bend_stiffness > 0.0f || cloth.settings.bend_damping > 0.0f;
}

/// A mesh body, and for how many ticks its swept boxes still have to be brought up to date: two after a move, the tick
/// in which it moves and the one in which it stands again.
struct MeshRecord {
  MeshCollider mesh;
  int stale_ticks = 0;

  explicit MeshRecord(MeshCollider&& m) : mesh(std::move(m)) {}
};

struct ColliderRecord {
  std::uint32_t shape = 0;  // PLEAT_COLLIDER_*
  ColliderKind kind = ColliderKind::kCapsule;
  std::uint32_t position = 0;  // in the columns of its kind
};

/// Gives an object back to the resource it came from.
struct MemoryDelete {
  std::pmr::memory_resource* memory = nullptr;
  template <class T>
  void operator()(T* object) const {
    std::pmr::polymorphic_allocator<>(memory).delete_object(object);
  }
};

/// A line to the host's log, or to stderr for warnings and errors where it has none.
void log_line(const pleat_world_def& host, std::uint32_t level, const std::string& line);

struct World {
  explicit World(const pleat_world_def& definition);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  pleat_world_def def;
  HostMemory memory;  // before all that lives on it

  Registry garment_handles, cloth_handles, collider_handles;
  std::pmr::vector<std::unique_ptr<GarmentRecord, MemoryDelete>> garments;
  std::pmr::vector<ClothRecord> clothes;
  std::pmr::vector<ColliderRecord> colliders;

  ParticleColumns particles;
  Vec3Column pin_previous, pin_next;  // m, where pins were at the last tick's end and shall be at the next one's
  Vec3Column held;                    // m/s2, what inner friction holds at rest; empty unless a cloth has it
  Vec3Column bending;                 // N, as long as it is held; empty unless a cloth resists bending
  RungeKuttaColumns runge_kutta;      // empty unless a cloth integrates by it
  SelfColumns self;                   // empty unless a cloth touches itself
  LayerColumns layers;                // empty unless a cloth has a layer
  SurfaceColumns surface;             // empty unless a cloth is drawn curved
  DrawnColumns drawn;                 // empty where smoothing is compiled out

  CapsuleColumns capsules;
  std::pmr::deque<MeshRecord> meshes;
  Column<PlaneCollider> planes;
  std::pmr::vector<const MeshCollider*> mesh_pointers;    // into `meshes`, in order
  std::unique_ptr<CollisionBodies, MemoryDelete> bodies;  // null while there is no collider
  bool capsules_filed = false;                            // in its tree: none came, went or changed since

  mutable std::pmr::vector<Worker> workers;        // at least one; scratch, also for questions
  std::unique_ptr<ThreadPool, MemoryDelete> pool;  // where there are more and the host has no parallel_for

  Column<DetailCandidate> detail;  // scratch of the budget, empty without one
  float cost = 0.0f, work = 0.0f;  // of a tick on average, by what the host told: ms, and systems/detail_choice.h
  float scarcity = 0.0f;           // of time, in the unit of importance: systems/detail_choice.h
  std::uint32_t turn = 0;          // below 8: turns.h

  Stats stats;
  std::uint64_t ticks = 0, substeps = 0;
  std::uint64_t last_jump = 0;  // `ticks` when a cloth last jumped, and bodies with it
  double time = 0.0;            // s, of all ticks so far: the gusts' clock

  mutable bool busy = false;  // see Busy

  void log(std::uint32_t level, const std::string& line) const { log_line(def, level, line); }
  bool has_colliders() const { return !colliders.empty(); }
};

/// While one lives the world may call its host back, and calls from there that would change the world are refused.
class Busy {
 public:
  explicit Busy(const World& world) : world_(world), before_(std::exchange(world.busy, true)) {}
  ~Busy() { world_.busy = before_; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  const World& world_;
  bool before_;
};

/// Takes the garment in. Throws std::bad_alloc; the world is unchanged then.
Handle add_garment(World& world, Garment&& garment);
void remove_garment(World& world, std::uint32_t position);

/// A cloth at `positions` (garment order, m; null: the rest shape), at rest. Throws std::bad_alloc; unchanged then.
Handle add_cloth(World& world, GarmentRecord& source, const pleat_cloth_settings& settings, const float* positions,
                 std::size_t stride);
void remove_cloth(World& world, std::uint32_t position);
/// Throws std::bad_alloc; unchanged then.
void set_cloth(World& world, ClothRecord& cloth, const pleat_cloth_settings& settings);
/// Forgets how a cloth has moved: for another state that takes the place of its own.
void forget_motion(World& world, ClothRecord& cloth);
/// Bytes of state that this cloth alone takes.
std::uint64_t bytes_of(const World& world, const ClothRecord& cloth);

/// A body at rest, next to those of its kind. Throws std::bad_alloc; the world is unchanged then.
Handle add_capsule(World& world, std::uint32_t shape, const Vec3& a, const Vec3& b);
Handle add_mesh(World& world, std::uint32_t shape, MeshCollider&& mesh);
Handle add_plane(World& world, const RigidPose& pose);
void remove_collider(World& world, std::uint32_t position);
/// Bullet's objects go when no capsule and no mesh is left.
void drop_idle_bodies(World& world);

}  // namespace pleat
