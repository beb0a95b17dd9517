#include "engine/border.h"
#include "engine/calls.h"
#include "engine/schedule.h"

namespace pleat::call {
namespace {

const pleat_cloth_def& default_cloth() {
  static const pleat_cloth_def def = [] {
    pleat_cloth_def d{};
    d.size = sizeof d;
    d.settings = {.size = sizeof(pleat_cloth_settings),
                  .integrator = PLEAT_INTEGRATOR_SYMPLECTIC_EULER,
                  .substeps = 0,
                  .sweeps = 3,
                  .density = 0.2f,
                  .stiffness = 30.0f,
                  .stretch_limit = 0.001f,
                  .bend_stiffness = 5e-5f,
                  .edge_damping = 4.0f,
                  .bend_damping = 4.0f,
                  .air_damping = 0.1f,
                  .drag_coefficient = 0.0f,
                  .thickness = 0.005f,
                  .friction = 0.2f,
                  .face_response = PLEAT_FACE_RESPONSE_WEIGHTED,
                  .surface = kHasSmoothing ? PLEAT_SURFACE_PLEAT : PLEAT_SURFACE_FLAT,
                  .level = PLEAT_LEVEL_FAN,
                  .lift_coefficient = 0.0f,
                  .inner_friction = 0.05f,
                  .inner_friction = 0.05f,
                  .fold_sweeps = 0,
                  .self_distance = 0.0f};
    return d;
  }();
  return def;
}

void need_settings(const pleat_cloth_settings& s) {
  need_range("integrator", s.integrator, 0, PLEAT_INTEGRATOR_RUNGE_KUTTA_4);
  need_range("substeps", s.substeps, 0, 64);
  need_range("sweeps", s.sweeps, 1, 64);
  need_range("density", s.density, 1e-6, 1e4);
  need_range("stiffness", s.stiffness, 0, 1e12);
  need_range("stretch_limit", s.stretch_limit, 0, 1e6);
  need_range("bend_stiffness", s.bend_stiffness, 0, 1e6);
  need_range("edge_damping", s.edge_damping, 0, 1e6);
  need_range("bend_damping", s.bend_damping, 0, 1e6);
  need_range("air_damping", s.air_damping, 0, 1e6);
  need_range("drag_coefficient", s.drag_coefficient, 0, 1e3);
  need_range("lift_coefficient", s.lift_coefficient, 0, 1e3);
  need_range("thickness", s.thickness, 0, 1);
  need_range("friction", s.friction, 0, 10);
  need_range("face_response", s.face_response, 0, PLEAT_FACE_RESPONSE_WHOLE);
  need_range("surface", s.surface, 0, PLEAT_SURFACE_ARC_PN);
  need_range("level", s.level, 0, PLEAT_LEVEL_MAX);
  need_range("inner_friction", s.inner_friction, 0, 1e6);
  need_range("fold_sweeps", s.fold_sweeps, 0, 64);
  need_range("self_distance", s.self_distance, 0, 1);
  need_compiled(kHasCollision || s.self_distance == 0.0f, "self_distance", "PLEAT_COLLISION");
  need_compiled(kHasSmoothing || s.surface == PLEAT_SURFACE_FLAT, "a curved surface", "PLEAT_SMOOTHING");
}

void move_pins_to_particles(World& world, const ClothRecord& cloth) {
  const Garment& g = cloth.garment();
  for (std::uint32_t k = 0; k < g.pins.size(); ++k) {
    const Vec3 x = world.particles.position.view()[cloth.particle_begin + g.pins[k]];
    world.pin_previous.view().set(cloth.pin_begin + k, x);
    world.pin_next.view().set(cloth.pin_begin + k, x);
  }
}

/// Where the drawn surface is read from: what the tessellation made, or the coarse mesh where that is compiled out.
struct DrawnView {
  std::uint32_t vertex_count, triangle_count;
  ConstVec3View position, normal;  // normal.x is null for the coarse mesh
};

DrawnView drawn_view(const World& world, const ClothRecord& cloth) {
  if (const TessellationPattern* pattern = cloth.pattern()) {
    return {pattern->vertex_count, pattern->triangle_count, world.drawn.position.view().from(cloth.drawn_begin),
            world.drawn.normal.view().from(cloth.drawn_begin)};
  }
  const Garment& g = cloth.garment();
  return {g.particle_count, g.face_count, world.particles.position.view().from(cloth.particle_begin), {}};
}

/// Area-weighted normal of the faces around a coarse particle.
Vec3 coarse_normal(const Garment& g, ConstVec3View x, std::uint32_t i) {
  Vec3 sum;
  for (std::uint32_t k = g.around_begin[i]; k < g.around_begin[i + 1]; ++k) {
    const std::uint32_t f = g.faces_around[k];
    const Vec3 a = x[g.face_particle[0][f]];
    sum += cross(x[g.face_particle[1][f]] - a, x[g.face_particle[2][f]] - a);
  }
  return normalized_or(sum, {0.0f, 1.0f, 0.0f});
}

/// Where a drawn vertex lies on the coarse mesh, for attributes that are linear on it.
std::array<float, 2> coarse_uv(const Garment& g, std::uint32_t i) {
  return g.uv.size() != 0 ? std::array{g.uv[2 * i], g.uv[2 * i + 1]} : std::array{0.0f, 0.0f};
}

std::array<float, 2> drawn_uv(const Garment& g, const TessellationPattern* pattern, std::uint32_t v) {
  if (g.uv.size() == 0 || v < g.particle_count) return coarse_uv(g, v);
  std::array<float, 2> uv{};
  const auto blend = [&](std::uint32_t particle, float weight) {
    const std::array<float, 2> corner = coarse_uv(g, particle);
    uv[0] += weight * corner[0];
    uv[1] += weight * corner[1];
  };
  if (v < pattern->first_face_vertex) {
    const std::uint32_t k = v - pattern->first_edge_vertex, per_edge = pattern->segments - 1;
    const float t = static_cast<float>(k % per_edge + 1) / static_cast<float>(pattern->segments);
    blend(g.edge_particle[0][k / per_edge], 1.0f - t);
    blend(g.edge_particle[1][k / per_edge], t);
  } else {
    const std::uint32_t k = v - pattern->first_face_vertex;
    const std::uint32_t per_face = static_cast<std::uint32_t>(pattern->inner.size()), f = k / per_face;
    for (int c = 0; c < 3; ++c) blend(g.face_particle[c][f], pattern->inner[k % per_face].face[c]);
  }
  return uv;
}

}  // namespace

pleat_result cloth_def_init(pleat_cloth_def* def, size_t size) {
  return init_def("cloth_def_init", def, size, default_cloth());
}

pleat_result cloth_create(pleat_world* handle, const pleat_cloth_def* given, pleat_cloth* cloth) {
  return guarded(as_world(handle), "cloth_create", [&] {
    World& world = need_world(handle);
    need_pointer("cloth", cloth);
    const pleat_cloth_def def = read_def("def", given, default_cloth());
    GarmentRecord& source = *world.garments[need_handle("garment", world.garment_handles, def.garment)];
    need_settings(def.settings);
    const std::uint32_t count = def.positions != nullptr ? source.garment.particle_count : 0;
    const HostVectors start("positions", def.positions, def.position_stride, count);
    const std::size_t stride = def.position_stride != 0 ? def.position_stride : 3 * sizeof(float);
    const Handle added = add_cloth(world, source, def.settings, def.positions, stride);
    try {
      refresh(world, world.clothes.back());
    } catch (...) {
      remove_cloth(world, static_cast<std::uint32_t>(world.clothes.size() - 1));
      throw;
    }
    *cloth = {added.index, added.generation};
  });
}

pleat_result cloth_destroy(pleat_world* handle, pleat_cloth cloth) {
  return guarded(as_world(handle), "cloth_destroy", [&] {
    World& world = need_world(handle);
    remove_cloth(world, need_handle("cloth", world.cloth_handles, cloth));
  });
}

pleat_result cloth_get(const pleat_world* handle, pleat_cloth cloth, pleat_cloth_settings* settings) {
  return guarded(as_world(handle), "cloth_get", [&] {
    const ClothRecord& record = need_cloth(need_world(handle), cloth);
    need_pointer("settings", settings);
    need_range("settings.size", settings->size, sizeof settings->size, sizeof(pleat_cloth_settings));
    const std::uint32_t size = settings->size;
    std::memcpy(settings, &record.settings, size);
    settings->size = size;
  });
}

pleat_result cloth_set(pleat_world* handle, pleat_cloth cloth, const pleat_cloth_settings* settings) {
  return guarded(as_world(handle), "cloth_set", [&] {
    World& world = need_world(handle);
    ClothRecord& record = need_cloth(world, cloth);
    const pleat_cloth_settings wanted = read_def("settings", settings, record.settings);
    need_settings(wanted);
    const pleat_cloth_settings old = record.settings;
    set_cloth(world, record, wanted);
    try {
      refresh(world, record);
    } catch (...) {
      set_cloth(world, record, old);
      refresh(world, record);
      throw;
    }
  });
}

pleat_result cloth_info(const pleat_world* handle, pleat_cloth cloth, pleat_cloth_info* info) {
  return guarded(as_world(handle), "cloth_info", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    need_pointer("info", info);
    const DrawnView drawn = drawn_view(world, record);
    *info = {.particles = record.garment().particle_count,
             .triangles = record.garment().face_count,
             .drawn_vertices = drawn.vertex_count,
             .drawn_triangles = drawn.triangle_count,
             .substeps = record.substeps_taken,
             .bytes = bytes_of(world, record)};
  });
}

pleat_result cloth_move_pins(pleat_world* handle, pleat_cloth cloth, const float* positions, uint32_t stride,
                             uint32_t count) {
  return guarded(as_world(handle), "cloth_move_pins", [&] {
    World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    const std::size_t pins = record.garment().pins.size();
    if (count != pins)
      refuse("count is " + std::to_string(count) + ", the garment has " + std::to_string(pins) + " pins");
    const HostVectors next("positions", positions, stride, count);
    for (std::uint32_t k = 0; k < count; ++k) world.pin_next.view().set(record.pin_begin + k, next[k]);
  });
}

pleat_result cloth_read_particles(const pleat_world* handle, pleat_cloth cloth, float* positions, float* velocities,
                                  uint32_t capacity) {
  return guarded(as_world(handle), "cloth_read_particles", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    const std::uint32_t count = record.garment().particle_count;
    need_capacity("capacity", capacity, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3 x = world.particles.position.view()[record.particle_begin + i];
      const Vec3 v = world.particles.velocity.view()[record.particle_begin + i];
      if (positions != nullptr) std::memcpy(positions + 3 * i, &x, sizeof x);
      if (velocities != nullptr) std::memcpy(velocities + 3 * i, &v, sizeof v);
    }
  });
}

pleat_result cloth_write_particles(pleat_world* handle, pleat_cloth cloth, const float* positions,
                                   const float* velocities, uint32_t count) {
  return guarded(as_world(handle), "cloth_write_particles", [&] {
    World& world = need_world(handle);
    ClothRecord& record = need_cloth(world, cloth);
    const std::uint32_t particles = record.garment().particle_count;
    if (count != particles) {
      refuse("count is " + std::to_string(count) + ", the garment has " + std::to_string(particles) + " particles");
    }
    const HostVectors x("positions", positions, 0, count);
    const HostVectors v("velocities", velocities, 0, velocities != nullptr ? count : 0);
    for (std::uint32_t i = 0; i < count; ++i) {
      world.particles.position.view().set(record.particle_begin + i, x[i]);
      world.particles.velocity.view().set(record.particle_begin + i, velocities != nullptr ? v[i] : Vec3{});
    }
    move_pins_to_particles(world, record);
    record.self_pair_count = kNone;
    refresh(world, record);
  });
}

pleat_result cloth_read_vertices(const pleat_world* handle, pleat_cloth cloth, const pleat_vertex_target* target) {
  return guarded(as_world(handle), "cloth_read_vertices", [&] {
    const World& world = need_world(handle);
    const ClothRecord& record = need_cloth(world, cloth);
    need_pointer("target", target);
    need_pointer("target.data", target->data);
    const DrawnView drawn = drawn_view(world, record);
    need_capacity("target.capacity", target->capacity, drawn.vertex_count);
    const auto fits = [&](const char* name, std::uint32_t offset, std::uint32_t bytes) {
      if (offset != PLEAT_NO_ATTRIBUTE && std::uint64_t{offset} + bytes > target->stride) {
        refuse(std::string("target.") + name + " is " + std::to_string(offset) + ", beyond a stride of " +
               std::to_string(target->stride));
      }
      return offset != PLEAT_NO_ATTRIBUTE;
    };
    const bool with_position = fits("position_offset", target->position_offset, 12);
    const bool with_normal = fits("normal_offset", target->normal_offset, 12);
    const bool with_uv = fits("uv_offset", target->uv_offset, 8);

    char* out = static_cast<char*>(target->data);
    for (std::uint32_t i = 0; i < drawn.vertex_count; ++i, out += target->stride) {
      if (with_position) {
        const Vec3 x = drawn.position[i];
        std::memcpy(out + target->position_offset, &x, sizeof x);
      }
      if (with_normal) {
        const Vec3 n = drawn.normal.x != nullptr ? drawn.normal[i] : coarse_normal(record.garment(), drawn.position, i);
        std::memcpy(out + target->normal_offset, &n, sizeof n);
      }
      if (with_uv) {
        const std::array<float, 2> uv = drawn_uv(record.garment(), record.pattern(), i);
        std::memcpy(out + target->uv_offset, uv.data(), sizeof uv);
      }
    }
  });
}

pleat_result cloth_read_indices(const pleat_world* handle, pleat_cloth cloth, uint32_t* indices, uint32_t capacity) {
  return guarded(as_world(handle), "cloth_read_indices", [&] {
    const ClothRecord& record = need_cloth(need_world(handle), cloth);
    need_pointer("indices", indices);
    if (const TessellationPattern* pattern = record.pattern()) {
      need_capacity("capacity", capacity, pattern->indices.size());
      std::copy(pattern->indices.begin(), pattern->indices.end(), indices);
    } else {
      const Garment& g = record.garment();
      need_capacity("capacity", capacity, std::size_t{3} * g.face_count);
      for (std::uint32_t f = 0; f < g.face_count; ++f) {
        for (std::uint32_t k = 0; k < 3; ++k) indices[3 * f + k] = g.face_particle[k][f];
      }
    }
  });
}

}  // namespace pleat::call
