#include "engine/world.h"

#include <cstdio>
#include <cstring>

#include "engine/layers.h"
#include "engine/origin.h"
#include "engine/room.h"

#ifdef PLEAT_WITH_COLLISION
#include "systems/collision_bodies.h"
#else
namespace pleat {
class CollisionBodies {};
}  // namespace pleat
#endif

namespace pleat {
namespace {

/// Where the next range of `count` elements goes when `used` are taken.
std::uint32_t range_of(std::size_t count) { return static_cast<std::uint32_t>(padded(count)); }

void resize_particles(World& world, std::size_t size) {
  ParticleColumns& p = world.particles;
  for (Vec3Column* column : p.vectors()) column->resize(size);
  p.inverse_mass.resize(size);
  p.mass.resize(size);
}

void set_masses(World& world, const ClothRecord& cloth) {
  const Garment& g = cloth.garment();
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    const float area = g.particle_area[i];  // 0: no face uses the vertex, it stays inert
    const float mass = area > 0.0f ? area * cloth.settings.density + g.added_mass[i] : 0.0f;
    const std::uint32_t p = cloth.particle_begin + i;
    world.particles.mass[p] = mass;
    world.particles.inverse_mass[p] = g.pinned[i] || mass <= 0.0f ? 0.0f : 1.0f / mass;
  }
}

#ifdef PLEAT_WITH_SMOOTHING
/// The pattern of the cloth's level, made on first use.
void want_pattern(World& world, GarmentRecord& source, std::uint32_t level) {
  auto& pattern = source.patterns[level];
  if (!pattern) pattern.emplace(build_tessellation(source.garment, level, &world.memory));
}
#else
void want_pattern(World&, GarmentRecord&, std::uint32_t) {}
#endif

std::uint32_t drawn_range(const ClothRecord& cloth) {
  const TessellationPattern* pattern = cloth.pattern();
  return pattern != nullptr ? range_of(pattern->shaded_count()) : 0;
}

void resize_drawn(World& world, std::size_t size) {
  DrawnColumns& drawn = world.drawn;
  const bool with_tangents = drawn.tangent.size() != 0;
  drawn.position.reserve(size);
  drawn.normal.reserve(size);
  if (with_tangents) drawn.tangent.reserve(size), drawn.handedness.reserve(size);
  drawn.position.resize(size);
  drawn.normal.resize(size);
  if (with_tangents) drawn.tangent.resize(size), drawn.handedness.resize(size);
}

/// For columns that only some scenes have, or that had no room for their last cloth yet.
template <class AnyColumn>
void erase_if_present(AnyColumn& column, std::size_t begin, std::size_t count) {
  if (column.size() > begin) column.erase(begin, count);
}

/// Takes a cloth's drawn vertices out of the columns; the cloths behind it move down.
void close_drawn_gap(World& world, const ClothRecord& cloth) {
  const std::uint32_t count = drawn_range(cloth);
  world.drawn.position.erase(cloth.drawn_begin, count);
  world.drawn.normal.erase(cloth.drawn_begin, count);
  erase_if_present(world.drawn.tangent, cloth.drawn_begin, count);
  erase_if_present(world.drawn.handedness, cloth.drawn_begin, count);
  for (ClothRecord& other : world.clothes) {
    if (other.drawn_begin > cloth.drawn_begin) other.drawn_begin -= count;
  }
}

}  // namespace

World::World(const pleat_world_def& definition)
    : def(definition),
      memory(definition.allocate, definition.free, definition.memory_user),
      garment_handles(&memory),
      cloth_handles(&memory),
      collider_handles(&memory),
      garments(&memory),
      clothes(&memory),
      colliders(&memory),
      particles(&memory),
      pin_previous(&memory),
      pin_next(&memory),
      held(&memory),
      bending(&memory),
      runge_kutta(&memory),
      self(&memory),
      layers(&memory),
      surface(&memory),
      drawn(&memory),
      capsules(&memory),
      meshes(&memory),
      planes(&memory),
      mesh_pointers(&memory),
      workers(&memory),
      detail(&memory) {
  workers.reserve(def.workers);
  for (std::uint32_t k = 0; k < def.workers; ++k) workers.emplace_back(k, &memory);
  if (def.workers == 1 || def.parallel_for != nullptr) return;
  std::pmr::polymorphic_allocator<> allocator(&memory);
  pool = {allocator.new_object<ThreadPool>(def.workers), MemoryDelete{&memory}};
}

World::~World() = default;

void log_line(const pleat_world_def& host, std::uint32_t level, const std::string& line) {
  if (host.log != nullptr) {
    host.log(level, line.c_str(), host.log_user);
  } else if (level != PLEAT_LOG_INFO) {
    std::fprintf(stderr, "pleat: %s\n", line.c_str());
  }
}

Handle add_garment(World& world, Garment&& garment) {
  world.garment_handles.reserve_one();
  std::pmr::polymorphic_allocator<> allocator(&world.memory);
  std::unique_ptr<GarmentRecord, MemoryDelete> record(allocator.new_object<GarmentRecord>(std::move(garment)),
                                                      MemoryDelete{&world.memory});
  world.garments.push_back(std::move(record));
  return world.garment_handles.add();
}

void remove_garment(World& world, std::uint32_t position) {
  world.garments.erase(world.garments.begin() + position);
  world.garment_handles.remove(position);
}

Handle add_cloth(World& world, GarmentRecord& source, const pleat_cloth_settings& settings, const float* positions,
                 std::size_t stride) {
  const Garment& g = source.garment;
  ClothRecord cloth;
  cloth.source = &source;
  cloth.settings = settings;
  cloth.particle_begin = static_cast<std::uint32_t>(world.particles.mass.size());
  cloth.pin_begin = static_cast<std::uint32_t>(world.pin_next.size());
  cloth.drawn_begin = static_cast<std::uint32_t>(world.drawn.position.size());
  for (const ClothRecord& other : world.clothes) {
    cloth.normal_begin += range_of(other.garment().normal_count);
    cloth.edge_begin += range_of(other.garment().edge_count);
  }

  // Everything that can fail comes first; resizing a column keeps what is in it, so a failure leaves only spare room.
  world.cloth_handles.reserve_one();
  reserve_one_more(world.clothes);
  want_pattern(world, source, settings.level);
  const std::size_t particle_end = cloth.particle_begin + range_of(g.particle_count);
  const std::size_t pin_end = cloth.pin_begin + range_of(g.pins.size());
  try {
    resize_particles(world, particle_end);
    world.pin_previous.resize(pin_end);
    world.pin_next.resize(pin_end);
    resize_drawn(world, cloth.drawn_begin + drawn_range(cloth));
  } catch (...) {
    resize_particles(world, cloth.particle_begin);
    world.pin_previous.resize(cloth.pin_begin);
    world.pin_next.resize(cloth.pin_begin);
    resize_drawn(world, cloth.drawn_begin);
    throw;
  }

  const Vec3View position = world.particles.position.view().from(cloth.particle_begin);
  for (std::uint32_t i = 0; i < g.particle_count; ++i) {
    Vec3 x = g.rest_position.view()[i];
    if (positions != nullptr) std::memcpy(&x, reinterpret_cast<const char*>(positions) + i * stride, sizeof x);
    position.set(i, x);
  }
  for (std::uint32_t k = 0; k < g.pins.size(); ++k) {
    world.pin_previous.view().set(cloth.pin_begin + k, position[g.pins[k]]);
    world.pin_next.view().set(cloth.pin_begin + k, position[g.pins[k]]);
  }
  set_masses(world, cloth);
  ++source.users;
  world.clothes.push_back(cloth);
  recentre(world, world.clothes.back());
  return world.cloth_handles.add();
}

void remove_cloth(World& world, std::uint32_t position) {
  forget_layer_pairs(world, world.clothes[position]);
  renumber_layer_pairs(world, position);
  const ClothRecord cloth = world.clothes[position];
  const Garment& g = cloth.garment();
  const std::uint32_t particles = range_of(g.particle_count), pins = range_of(g.pins.size()),
                      normals = range_of(g.normal_count), edges = range_of(g.edge_count);
  ParticleColumns& p = world.particles;
  for (Vec3Column* column : p.vectors()) column->erase(cloth.particle_begin, particles);
  p.inverse_mass.erase(cloth.particle_begin, particles);
  p.mass.erase(cloth.particle_begin, particles);
  for (Vec3Column* column :
       {&world.held, &world.bending, &world.runge_kutta.start_velocity, &world.runge_kutta.position_slope,
        &world.runge_kutta.velocity_slope, &world.self.sought_at, &world.layers.sought_at, &world.layers.begin}) {
    erase_if_present(*column, cloth.particle_begin, particles);
  }
  constexpr std::size_t kPairs = SelfColumns::kPairsPerParticle;
  erase_if_present(world.self.pairs, kPairs * cloth.particle_begin, kPairs * particles);
  erase_if_present(world.layers.pairs, kPairs * cloth.particle_begin, kPairs * particles);
  erase_if_present(world.layers.clothes, position, 1);
  world.pin_previous.erase(cloth.pin_begin, pins);
  world.pin_next.erase(cloth.pin_begin, pins);
  erase_if_present(world.surface.normal, cloth.normal_begin, normals);
  erase_if_present(world.surface.fold, cloth.edge_begin, edges);
  erase_if_present(world.surface.fold_height, cloth.edge_begin, edges);
  erase_if_present(world.surface.fold_side, cloth.edge_begin, edges);
  close_drawn_gap(world, cloth);

  world.clothes.erase(world.clothes.begin() + position);
  for (std::size_t i = position; i < world.clothes.size(); ++i) {
    ClothRecord& later = world.clothes[i];
    later.particle_begin -= particles;
    later.pin_begin -= pins;
    later.normal_begin -= normals;
    later.edge_begin -= edges;
  }
  --cloth.source->users;
  world.cloth_handles.remove(position);
}

void forget_motion(World& world, ClothRecord& cloth) {
  const std::size_t particles = cloth.garment().particle_count;
  for (Vec3Column* column : {&world.held, &world.bending}) {
    if (column->size() != 0) clear(column->view().from(cloth.particle_begin), particles);
  }
  cloth.bending_left = 0.0f;
  cloth.self_pair_count = cloth.layer_pair_count = kNone;
}

void set_cloth(World& world, ClothRecord& cloth, const pleat_cloth_settings& settings) {
  const pleat_cloth_settings& old = cloth.settings;
  ClothRecord wanted = cloth;
  wanted.settings = settings;
  want_pattern(world, *cloth.source, settings.level);
  make_room(world, wanted);
  if (settings.level != old.level) {
    const std::size_t old_end = world.drawn.position.size();
    resize_drawn(world, old_end + drawn_range(wanted));
    const std::uint32_t old_count = drawn_range(cloth);
    close_drawn_gap(world, cloth);
    cloth.drawn_begin = static_cast<std::uint32_t>(old_end) - old_count;
  }
  if (settings.self_distance != old.self_distance) cloth.self_pair_count = kNone;
  if (settings.layer != old.layer) forget_layer_pairs(world, cloth);
  if (settings.thickness != old.thickness) cloth.layer_pair_count = kNone;
  if (settings.surface != old.surface) cloth.sides_known = false;
  if (settings.inner_friction == 0.0f && world.held.size() != 0) {
    clear(world.held.view().from(cloth.particle_begin), cloth.garment().particle_count);
  }
  if (settings.stiffness != old.stiffness || settings.bend_stiffness != old.bend_stiffness) {
    cloth.lowered = Notice::kNothing;
  }
  cloth.settings = settings;
  set_masses(world, cloth);
}

std::uint64_t bytes_of(const World& world, const ClothRecord& cloth) {
  const Garment& g = cloth.garment();
  const std::uint64_t particle =
      7 * sizeof(Vec3) + 2 * sizeof(float) + (world.held.size() != 0 ? sizeof(Vec3) : 0) +
      (world.bending.size() != 0 ? sizeof(Vec3) : 0) +
      (world.runge_kutta.start_velocity.size() != 0 ? 3 * sizeof(Vec3) : 0) +
      (world.self.pairs.size() != 0 ? sizeof(Vec3) + SelfColumns::kPairsPerParticle * sizeof(NearPair) : 0) +
      (world.layers.pairs.size() != 0 ? 2 * sizeof(Vec3) + SelfColumns::kPairsPerParticle * sizeof(NearPair) : 0);
  const std::uint64_t normal = world.surface.normal.size() != 0 ? sizeof(Vec3) : 0;
  const std::uint64_t edge = world.surface.fold.size() != 0 ? sizeof(Vec3) + 2 * sizeof(float) : 0;
  const std::uint64_t drawn = 2 * sizeof(Vec3) + (world.drawn.tangent.size() != 0 ? sizeof(Vec3) + sizeof(float) : 0);
  return sizeof(ClothRecord) + range_of(g.particle_count) * particle + range_of(g.pins.size()) * 2 * sizeof(Vec3) +
         range_of(g.normal_count) * normal + range_of(g.edge_count) * edge + drawn_range(cloth) * drawn;
}

}  // namespace pleat
