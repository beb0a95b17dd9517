// The state of a world as bytes: counted, written, checked and read by one list of what it consists of.
#include <array>
#include <utility>

#include "engine/border.h"
#include "engine/budget.h"
#include "engine/calls.h"
#include "engine/cloth_tick.h"
#include "engine/schedule.h"
#include "engine/state_bytes.h"
#ifdef PLEAT_WITH_COLLISION
#include "systems/collision_bodies.h"
#endif

namespace pleat::call {
namespace {

constexpr std::uint32_t kMagic = 0x54414c50;  // "PLAT", and which end of a number comes first
constexpr std::uint32_t kFormat = 5;          // one more whenever the list below changes

/// Pairs of a cloth with itself or with those below it, in the order in which they are found.
template <class Io, class Pairs>
void near_pairs(Io& io, const World& world, const ClothRecord& cloth, Pairs& column, std::uint32_t count) {
  const std::size_t begin = std::size_t{SelfColumns::kPairsPerParticle} * cloth.particle_begin;
  const auto below = [](std::size_t end) { return Range{0.0, static_cast<double>(end) - 1.0}; };
  const Garment& own = cloth.garment();
  const bool itself = &column == &world.self.pairs;
  std::array<std::uint32_t, 3> last{};
  for (std::uint32_t k = 0; k < count; ++k) {
    auto& pair = column[begin + k];
    auto kind = static_cast<std::uint32_t>(pair.kind);
    number(io, "pair", kind, {0.0, itself ? 1.0 : 2.0});
    const std::uint32_t cloth_of = number(io, "pair", pair.cloth, below(itself ? 1 : world.clothes.size()));
    const std::uint32_t layer = world.clothes[cloth_of].settings.layer;
    if (!itself) io.need(layer > 0 && layer < cloth.settings.layer, "the state's pair is with no layer below");
    const Garment& other = itself ? own : world.clothes[cloth_of].garment();
    const auto is = static_cast<NearKind>(kind);
    const bool swapped = is == NearKind::kOtherParticleFace;
    const Garment &first = swapped ? other : own, &second = swapped ? own : other;
    number(io, "pair", pair.first, below(is == NearKind::kEdges ? first.edge_count : first.particle_count));
    const std::uint32_t second_of =
        number(io, "pair", pair.second, below(is == NearKind::kEdges ? second.edge_count : second.face_count));
    const std::array<std::uint32_t, 3> place{cloth_of, kind, second_of};
    io.need(std::exchange(last, place) <= place, "the state's pairs are not in order");
    number(io, "pair", pair.distance, kPositive);
    number(io, "pair", pair.side, kUnit);
    if constexpr (!std::is_const_v<Pairs>) pair.kind = is;
  }
}
/// How many of them there are, if any were sought yet.
template <class Io, class Count>
std::uint32_t pair_count(Io& io, const ClothRecord& cloth, Count& count) {
  std::uint32_t known = count + 1;  // 0: none were sought
  number(io, "pairs", known,
         {0.0, SelfColumns::kPairsPerParticle * static_cast<double>(cloth.garment().particle_count) + 1.0});
  if constexpr (!std::is_const_v<Count>) count = known - 1;
  return known - 1;
}

/// What the world must have in common with the one that was saved.
template <class Io>
void visit_shape(const World& world, Io& io, std::uint64_t bytes) {
  io.same("magic number", kMagic);
  io.same("format", kFormat);
  for (const char c : PLEAT_VERSION_STRING) io.same("library's version", c);
  io.same("library's features", kFeatures);
  io.same("size in bytes", bytes);
  io.same("number of cloths", static_cast<std::uint32_t>(world.clothes.size()));
  io.same("number of colliders", static_cast<std::uint32_t>(world.colliders.size()));
  for (std::uint32_t i = 0; i < world.clothes.size(); ++i) {
    const ClothRecord& cloth = world.clothes[i];
    const Garment& g = cloth.garment();
    const pleat_cloth_settings& s = cloth.settings;
    io.same("particle count of cloth", g.particle_count, i);
    io.same("pin count of cloth", static_cast<std::uint32_t>(g.pins.size()), i);
    io.same("face count of cloth", g.face_count, i);
    io.same("edge count of cloth", g.edge_count, i);
    io.same("hinge count of cloth", g.hinge_count, i);
    io.same("normal count of cloth", g.normal_count, i);
    io.same("drawn vertex count of cloth", cloth.pattern() != nullptr ? cloth.pattern()->shaded_count() : 0, i);
    io.same("surface of cloth", s.surface, i);
    io.same("level of cloth", s.level, i);
    io.same("tangents of cloth", s.tangents, i);
    io.same("layer of cloth", s.layer, i);
    io.same("use of inner_friction by cloth", std::uint32_t{s.inner_friction > 0.0f}, i);
    io.same("use of bending by cloth", std::uint32_t{resists_bending(cloth)}, i);
    io.same("use of self_distance by cloth", std::uint32_t{s.self_distance > 0.0f}, i);
  }
  for (std::uint32_t i = 0; i < world.colliders.size(); ++i) {
    const ColliderRecord& body = world.colliders[i];
    io.same("shape of collider", body.shape, i);
    if (body.kind != ColliderKind::kMesh) continue;
    const MeshCollider& mesh = world.meshes[body.position].mesh;
    io.same("vertex count of collider", static_cast<std::uint32_t>(mesh.next.size()), i);
    io.same("index count of collider", static_cast<std::uint32_t>(mesh.triangles.size()), i);
  }
}

/// The surface as it was drawn, and what the next one goes by.
template <class W, class Io, class Cloth>
void visit_surface(W& world, Io& io, Cloth& cloth, bool folded, bool sides_known) {
  const TessellationPattern* pattern = cloth.pattern();
  if (pattern == nullptr) return;
  const pleat_cloth_settings& s = cloth.settings;
  const std::size_t normals = cloth.garment().normal_count, edges = cloth.garment().edge_count;
  if (s.surface != PLEAT_SURFACE_FLAT) {
    vectors(io, "normals", world.surface.normal.view().from(cloth.normal_begin), normals, kFinite);
  }
  if (folded && has_folds(static_cast<SurfaceMode>(s.surface))) {
    vectors(io, "folds", world.surface.fold.view().from(cloth.edge_begin), edges, kFinite);
    io.array("fold heights", world.surface.fold_height.data() + cloth.edge_begin, edges, kPlace);
  }
  if (sides_known && s.surface == PLEAT_SURFACE_PLEAT) {
    io.array("fold sides", world.surface.fold_side.data() + cloth.edge_begin, edges, kUnit);
  }
  const std::size_t shaded = pattern->shaded_count();
  vectors(io, "drawn positions", world.drawn.position.view().from(cloth.drawn_begin), pattern->vertex_count, kPlace);
  vectors(io, "drawn normals", world.drawn.normal.view().from(cloth.drawn_begin), shaded, kNormal);
  if (s.tangents == 0) return;
  vectors(io, "tangents", world.drawn.tangent.view().from(cloth.drawn_begin), shaded, kNormal);
  io.array("tangents", world.drawn.handedness.data() + cloth.drawn_begin, shaded, kNormal);
}

template <class W, class Io, class Cloth>
void visit_cloth(W& world, Io& io, Cloth& cloth) {
  const pleat_cloth_settings& s = cloth.settings;
  const std::size_t particles = cloth.garment().particle_count, pins = cloth.garment().pins.size();
  vector(io, "origin", cloth.origin, kPlace);
  vectors(io, "positions", world.particles.position.view().from(cloth.particle_begin), particles, kPlace);
  vectors(io, "velocities", world.particles.velocity.view().from(cloth.particle_begin), particles, kFinite);
  vectors(io, "pins", world.pin_previous.view().from(cloth.pin_begin), pins, kPlace);
  vectors(io, "pins", world.pin_next.view().from(cloth.pin_begin), pins, kPlace);
  if (s.inner_friction > 0.0f) {
    vectors(io, "inner friction", world.held.view().from(cloth.particle_begin), particles, kFinite);
  }
  if (resists_bending(cloth)) {
    vectors(io, "bending", world.bending.view().from(cloth.particle_begin), particles, kFinite);
  }
  if (s.self_distance > 0.0f) {
    const std::uint32_t count = pair_count(io, cloth, cloth.self_pair_count);
    if (count != kNone) {
      vectors(io, "pairs", world.self.sought_at.view().from(cloth.particle_begin), particles, kPlace);
      near_pairs(io, world, cloth, world.self.pairs, count);
    }
  }
  if (s.layer > 1) {
    const std::uint32_t count = pair_count(io, cloth, cloth.layer_pair_count);
    if (count != kNone) {
      vectors(io, "pairs", world.layers.sought_at.view().from(cloth.particle_begin), particles, kPlace);
      auto& sought = cloth.layers_sought;
      const std::uint32_t near = number(io, "pairs", sought.near.count, {0.0, LayersNear::kMost + 1.0});
      for (std::uint32_t k = 0; k < std::min(near, LayersNear::kMost); ++k) {
        number(io, "pairs", sought.near.cloth[k], {0.0, static_cast<double>(world.clothes.size()) - 1.0});
      }
      vector(io, "pairs", sought.motion, kPlace);
      number(io, "pairs", sought.others, kPositive);
      flag(io, "pairs", sought.cut);
      near_pairs(io, world, cloth, world.layers.pairs, count);
    }
  }
  number(io, "substeps", cloth.substeps_taken, {0.0, 8.0 * kMostSubsteps});
  number(io, "substeps", cloth.substeps_wanted, {0.0, kMostSubsteps});
  for (auto* count : {&cloth.contacts.particle, &cloth.contacts.face, &cloth.contacts.self, &cloth.contacts.dropped}) {
    number(io, "contacts", *count, kCount);
  }
  vector(io, "pins' velocity", cloth.pin_velocity, kFinite);
  number(io, "importance", cloth.importance, {0.0, double{kMostImportance}});
  number(io, "detail", cloth.given_up, {0.0, kMostGivenUp});
  const bool folded = number(io, "detail", cloth.fold_share, kShare) > 0.0f;
  number(io, "detail", cloth.substep_share, kShare);
  flag(io, "detail", cloth.carried);
  number(io, "detail", cloth.travelled, kPositive);
  number(io, "detail", cloth.young, kPositive);
  number(io, "bending's time", cloth.bending_left, kFinite);
  number(io, "calm", cloth.calm, kPositive);
  number(io, "settling", cloth.settling, kPositive);
  bool jumps = cloth.declared_jump.has_value();
  if (flag(io, "jump", jumps)) {
    RigidMotion jump = cloth.declared_jump.value_or(RigidMotion{});
    vector(io, "jump", jump.from, kPlace), vector(io, "jump", jump.to, kPlace), rotation(io, "jump", jump.rotation);
    if constexpr (!std::is_const_v<Cloth>) cloth.declared_jump = jump;
  } else if constexpr (!std::is_const_v<Cloth>) {
    cloth.declared_jump.reset();
  }
  const bool sides_known = flag(io, "fold sides", cloth.sides_known);
  flag(io, "pins", cloth.pins_told);
  if (flag(io, "visible", cloth.visible)) visit_surface(world, io, cloth, folded, sides_known);
}

template <class W, class Io>
void visit_bodies(W& world, Io& io) {
  auto& c = world.capsules;
  for (auto* column : {&c.previous_a, &c.previous_b, &c.next_a, &c.next_b}) {
    vectors(io, "capsules", column->view(), c.size(), kPlace);
  }
  io.array("capsules", c.enabled.data(), c.size(), kYesOrNo);
  for (auto& record : world.meshes) {
    auto& mesh = record.mesh;
    vectors(io, "mesh bodies", mesh.previous.view(), mesh.previous.size(), kPlace);
    vectors(io, "mesh bodies", mesh.next.view(), mesh.next.size(), kPlace);
    pose(io, "boxes and hulls", mesh.previous_pose), pose(io, "boxes and hulls", mesh.next_pose);
    number(io, "boxes and hulls", mesh.bow, kPositive);
    flag(io, "mesh bodies", mesh.enabled);
  }
  for (auto& plane : world.planes) {
    pose(io, "planes", plane.previous), pose(io, "planes", plane.next);
    flag(io, "planes", plane.enabled);
  }
}

/// bytes: of the whole state.
template <class W, class Io>
void visit(W& world, Io& io, std::uint64_t bytes) {
  visit_shape(world, io, bytes);
  number(io, "time", world.time, kTime);
  number(io, "pace", world.cost, kPositive);
  number(io, "pace", world.work, kPositive);
  number(io, "scarcity", world.scarcity, {0.0, double{kLoss.back() * kMostImportance}});
  number(io, "turn", world.turn, {0.0, kTicksParted.back() - 1.0});
  visit_bodies(world, io);
  for (auto& cloth : world.clothes) visit_cloth(world, io, cloth);
}

std::uint64_t state_bytes(const World& world) {
  if (world.busy) refuse("the world is busy: it has a state between ticks only");
  Counting io;
  visit(world, io, 0);
  return io.bytes;
}

/// What follows from the state.
void catch_up(World& world) {
  for (ClothRecord& cloth : world.clothes) {
    replan(world, cloth);
    if (cloth.fold_share == 0.0f) flatten_folds(world, cloth);
  }
  world.capsules_filed = false;
#ifdef PLEAT_WITH_COLLISION
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    world.bodies->update_mesh(i, world.meshes[i].mesh);
    world.meshes[i].stale_ticks = 2;
  }
#endif
}

}  // namespace

pleat_result world_state_size(const pleat_world* handle, uint64_t* bytes) {
  return guarded(as_world(handle), "world_state_size", [&] {
    const World& world = need_world(handle);
    need_pointer("bytes", bytes);
    *bytes = state_bytes(world);
  });
}

pleat_result world_save(const pleat_world* handle, void* to, uint64_t capacity) {
  return guarded(as_world(handle), "world_save", [&] {
    const World& world = need_world(handle);
    need_pointer("to", to);
    const std::uint64_t bytes = state_bytes(world);
    need_capacity("capacity", capacity, bytes);
    Writing io{static_cast<char*>(to)};
    visit(world, io, bytes);
  });
}

pleat_result world_load(pleat_world* handle, const void* from, uint64_t bytes) {
  return guarded(as_world(handle), "world_load", [&] {
    World& world = need_world(handle);
    need_pointer("from", from);
    Reading checking{static_cast<const char*>(from), bytes};
    visit(std::as_const(world), checking, bytes);
    if (checking.left != 0) refuse("bytes is too large: the state ends before");
    Reading reading{static_cast<const char*>(from), bytes};
    visit(world, reading, bytes);
    catch_up(world);
  });
}

}  // namespace pleat::call
