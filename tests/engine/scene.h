// A world behind its C interface, with what tests want to see of its inside.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "engine/calls.h"
#include "engine/schedule.h"
#include "engine/world.h"

namespace pleat {

/// Fails the test that calls it when the result is not PLEAT_OK.
inline void must(pleat_result result) { ASSERT_EQ(result, pleat_result{PLEAT_OK}); }

/// What a world's state is saved to.
using Bytes = std::vector<unsigned char>;

class Scene {
 public:
  Scene() : Scene(default_def()) {}
  explicit Scene(const pleat_world_def& def) { must(call::world_create(&def, &world_)); }
  ~Scene() { call::world_destroy(world_); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  static pleat_world_def default_def() {
    pleat_world_def def;
    must(call::world_def_init(&def, sizeof def));
    return def;
  }
  static pleat_cloth_settings default_settings() {
    pleat_cloth_def def;
    must(call::cloth_def_init(&def, sizeof def));
    return def.settings;
  }

  operator pleat_world*() { return world_; }
  World& inside() { return *reinterpret_cast<World*>(world_); }

  /// A sheet of n x n particles of 1 m2, held at two corners, or at the first of them, or at none.
  pleat_garment sheet(std::uint32_t n, std::uint32_t pin_count = 2) {
    pleat_shape_def shape;
    must(call::shape_def_init(&shape, sizeof shape));
    shape.rows = shape.columns = n;
    std::uint32_t vertices = 0, triangles = 0;
    must(call::shape_size(&shape, &vertices, &triangles));
    std::vector<float> positions(3 * vertices);
    std::vector<std::uint32_t> indices(3 * triangles);
    must(call::shape_build(&shape, positions.data(), indices.data()));
    const std::uint32_t pins[] = {0, n - 1};
    pleat_garment_def def;
    must(call::garment_def_init(&def, sizeof def));
    def.positions = positions.data();
    def.vertex_count = vertices;
    def.triangles = indices.data();
    def.triangle_count = triangles;
    def.pins = pins;
    def.pin_count = pin_count;
    pleat_garment garment{};
    must(call::garment_create(world_, &def, nullptr, &garment));
    return garment;
  }
  pleat_cloth cloth(pleat_garment garment, const pleat_cloth_settings& settings = default_settings()) {
    pleat_cloth_def def;
    must(call::cloth_def_init(&def, sizeof def));
    def.garment = garment;
    def.settings = settings;
    pleat_cloth cloth{};
    must(call::cloth_create(world_, &def, &cloth));
    return cloth;
  }
  pleat_collider sphere(float x, float y, float z, float radius) {
    pleat_collider_def def;
    must(call::collider_def_init(&def, sizeof def));
    def.a[0] = def.b[0] = x, def.a[1] = def.b[1] = y, def.a[2] = def.b[2] = z;
    def.radius = radius;
    pleat_collider collider{};
    must(call::collider_create(world_, &def, &collider));
    return collider;
  }
  pleat_cloth_settings settings(pleat_cloth cloth) {
    pleat_cloth_settings s{};
    s.size = sizeof s;
    must(call::cloth_get(world_, cloth, &s));
    return s;
  }
  void step(int ticks = 1, float dt = 1.0f / 60) {
    for (int i = 0; i < ticks; ++i) must(call::world_step(world_, dt));
  }

  /// Positions, then velocities.
  std::vector<float> particles(pleat_cloth cloth) {
    const std::uint32_t n = info(cloth).particles;
    std::vector<float> state(6 * n);
    must(call::cloth_read_particles(world_, cloth, state.data(), state.data() + 3 * n, n));
    return state;
  }
  /// Position, normal and uv of each drawn vertex.
  std::vector<float> vertices(pleat_cloth cloth) {
    const std::uint32_t n = info(cloth).drawn_vertices;
    std::vector<float> drawn(8 * n);
    pleat_vertex_target target{};
    must(call::vertex_target_init(&target, sizeof target));
    target.data = drawn.data(), target.stride = 32, target.capacity = n;
    target.position_offset = 0, target.normal_offset = 12, target.uv_offset = 24;
    must(call::cloth_read_vertices(world_, cloth, &target));
    return drawn;
  }
  pleat_cloth_info info(pleat_cloth cloth) {
    pleat_cloth_info info{};
    info.size = sizeof info;
    must(call::cloth_info(world_, cloth, &info));
    return info;
  }
  pleat_stats stats() {
    pleat_stats stats{};
    stats.size = sizeof stats;
    must(call::world_stats(world_, &stats));
    return stats;
  }
  Bytes saved() {
    std::uint64_t bytes = 0;
    must(call::world_state_size(*this, &bytes));
    Bytes state(bytes);
    must(call::world_save(*this, state.data(), bytes));
    return state;
  }
  pleat_result load(const Bytes& state) { return call::world_load(*this, state.data(), state.size()); }
  /// The plan's line for a system; empty where there is none.
  std::string explain(const std::string& system) {
    struct Search {
      std::string system, line;
    } search{system + " ", ""};
    must(call::world_explain(
        world_,
        [](const char* line, void* user) {
          Search& s = *static_cast<Search*>(user);
          if (std::string(line).starts_with(s.system)) s.line = line;
        },
        &search));
    return search.line;
  }

 private:
  pleat_world* world_ = nullptr;
};

/// The same bits, NaN included.
inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace pleat
