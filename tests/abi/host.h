// A host of the shared library: its table, its log, its allocator, and a world in which to break one thing a time.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "engine/pleat.h"

namespace pleat::abi {

inline const pleat_api& api() { return *pleat_get_api(PLEAT_API_MAJOR); }

/// What the world's log and allocator do; lives longer than the world.
struct Services {
  std::string log;
  long allowed = -1;  // allocations until the host says no; negative: never
  std::size_t bytes = 0;

  static void write(std::uint32_t, const char* line, void* user) {
    static_cast<Services*>(user)->log += line + std::string("\n");
  }
  static void* allocate(std::size_t bytes, std::size_t alignment, void* user) {
    Services& host = *static_cast<Services*>(user);
    if (host.allowed == 0) return nullptr;
    if (host.allowed > 0) --host.allowed;
    host.bytes += bytes;
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  static void release(void* memory, std::size_t bytes, std::size_t, void* user) {
    static_cast<Services*>(user)->bytes -= bytes;
    std::free(memory);
  }
};

/// A def of the C interface with its defaults.
template <class Def>
Def made(pleat_result (*init)(Def*, std::size_t)) {
  Def def;
  EXPECT_EQ(init(&def, sizeof def), pleat_result{PLEAT_OK});
  return def;
}

/// Interleaved position, normal, uv: 32 bytes a vertex.
inline pleat_vertex_target vertex_target(void* data, std::uint32_t capacity) {
  pleat_vertex_target target = made(api().vertex_target_init);
  target.data = data, target.stride = 32, target.capacity = capacity;
  target.position_offset = 0, target.normal_offset = 12, target.uv_offset = 24;
  return target;
}

/// A square of 3 x 3 vertices, two of them pinned: a valid garment to start from.
struct Square {
  std::vector<float> positions = std::vector<float>(27), uvs = std::vector<float>(18);
  std::vector<std::uint32_t> triangles = std::vector<std::uint32_t>(24), pins{0, 2}, seams{1, 4};

  Square() {
    pleat_shape_def shape = made(api().shape_def_init);
    shape.rows = shape.columns = 3;
    EXPECT_EQ(api().shape_build(&shape, positions.data(), triangles.data()), pleat_result{PLEAT_OK});
    for (std::size_t i = 0; i < 9; ++i) uvs[2 * i] = positions[3 * i] + 0.5f, uvs[2 * i + 1] = positions[3 * i + 2];
  }
  pleat_garment_def def() {
    pleat_garment_def def = made(api().garment_def_init);
    def.positions = positions.data();
    def.vertex_count = 9;
    def.triangles = triangles.data();
    def.triangle_count = 8;
    def.uvs = uvs.data();
    def.pins = pins.data();
    def.pin_count = 2;
    def.seams = seams.data();
    def.seam_count = 1;
    return def;
  }
};

class Host : public testing::Test {
 protected:
  Host() {
    pleat_world_def def = made(api().world_def_init);
    def.log = &Services::write;
    def.log_user = def.memory_user = &services;
    def.allocate = &Services::allocate;
    def.free = &Services::release;
    EXPECT_EQ(api().world_create(&def, &world), pleat_result{PLEAT_OK});
    pleat_garment_def garment_def = square.def();
    EXPECT_EQ(api().garment_create(world, &garment_def, nullptr, &garment), pleat_result{PLEAT_OK});
    pleat_cloth_def cloth_def = made(api().cloth_def_init);
    cloth_def.garment = garment;
    EXPECT_EQ(api().cloth_create(world, &cloth_def, &cloth), pleat_result{PLEAT_OK});
    EXPECT_EQ(api().world_step(world, 0.02f), pleat_result{PLEAT_OK});
  }
  ~Host() override {
    api().world_destroy(world);
    EXPECT_EQ(services.bytes, 0u) << "leaked";
  }

  /// Everything that can be read about the cloth: particles, drawn vertices, settings.
  std::vector<float> state() {
    pleat_cloth_info info{};
    info.size = sizeof info;
    EXPECT_EQ(api().cloth_info(world, cloth, &info), pleat_result{PLEAT_OK});
    std::vector<float> all(6 * 9 + 8 * info.drawn_vertices);
    EXPECT_EQ(api().cloth_read_particles(world, cloth, all.data(), all.data() + 27, 9), pleat_result{PLEAT_OK});
    const pleat_vertex_target target = vertex_target(all.data() + 54, info.drawn_vertices);
    EXPECT_EQ(api().cloth_read_vertices(world, cloth, &target), pleat_result{PLEAT_OK});
    pleat_cloth_settings s{};
    s.size = sizeof s;
    EXPECT_EQ(api().cloth_get(world, cloth, &s), pleat_result{PLEAT_OK});
    for (const std::uint32_t value :
         {s.integrator, s.substeps, s.sweeps, s.face_response, s.surface, s.level, s.tangents}) {
      all.push_back(static_cast<float>(value));
    }
    all.insert(all.end(), {s.density, s.stiffness, s.stretch_limit, s.bend_stiffness, s.edge_damping, s.bend_damping,
                           s.air_damping, s.drag_coefficient, s.lift_coefficient, s.thickness, s.friction,
                           s.inner_friction, s.buckling_strain});
    return all;
  }

  /// The call is refused with `result`, the log names `field`, and nothing has changed.
  template <class Call>
  void expect_refused(pleat_result result, const std::string& field, Call call) {
    const std::vector<float> before = state();
    services.log.clear();
    EXPECT_EQ(call(), result) << field;
    EXPECT_NE(services.log.find(field), std::string::npos) << "'" << field << "' is not in: " << services.log;
    EXPECT_EQ(state(), before) << field;
  }

  Services services;
  Square square;
  pleat_world* world = nullptr;
  pleat_garment garment{};
  pleat_cloth cloth{};
};

}  // namespace pleat::abi
