#include <numbers>
#include <vector>

#include "components/shapes.h"
#include "engine/border.h"
#include "engine/calls.h"

namespace pleat::call {
namespace {

const pleat_shape_def& default_shape() {
  static const pleat_shape_def def = [] {
    pleat_shape_def d{};
    d.size = sizeof d;
    d.rows = d.columns = 9;
    d.width = d.depth = 1.0f;
    return d;
  }();
  return def;
}

const pleat_garment_def& default_garment() {
  static const pleat_garment_def def = [] {
    pleat_garment_def d{};
    d.size = sizeof d;
    d.crease_angle = std::numbers::pi_v<float>;
    return d;
  }();
  return def;
}

void need_size(std::uint64_t vertices, std::uint64_t triangles) {
  if (vertices > PLEAT_MAX_PARTICLES || triangles > PLEAT_MAX_TRIANGLES) {
    refuse("a mesh of " + std::to_string(vertices) + " vertices and " + std::to_string(triangles) +
               " triangles is more than " + std::to_string(PLEAT_MAX_PARTICLES) + " and " +
               std::to_string(PLEAT_MAX_TRIANGLES),
           PLEAT_ERROR_CAPACITY);
  }
}

struct Size {
  std::uint64_t vertices = 0, triangles = 0;
};

/// Checks the shape; what it will have.
Size measure(const pleat_shape_def& def) {
  Size size;
  if (def.kind == PLEAT_SHAPE_GRID) {
    need_range("rows", def.rows, 2, PLEAT_MAX_PARTICLES);
    need_range("columns", def.columns, 2, PLEAT_MAX_PARTICLES);
    need_range("width", def.width, 1e-3, 1e4);
    need_range("depth", def.depth, 1e-3, 1e4);
    size.vertices = std::uint64_t{def.rows} * def.columns;
    size.triangles = 2 * (std::uint64_t{def.rows} - 1) * (std::uint64_t{def.columns} - 1);
  } else if (def.kind == PLEAT_SHAPE_RINGS) {
    need_range("ring_count", def.ring_count, 2, 4096);
    need_pointer("ring_sizes", def.ring_sizes);
    need_pointer("ring_radii", def.ring_radii);
    need_pointer("ring_heights", def.ring_heights);
    for (std::uint32_t r = 0; r < def.ring_count; ++r) {
      need_range("ring_sizes", def.ring_sizes[r], 3, PLEAT_MAX_PARTICLES);
      need_range("ring_radii", def.ring_radii[r], 1e-3, 1e4);
      need_range("ring_heights", def.ring_heights[r], -1e4, 1e4);
      size.vertices += def.ring_sizes[r];
      if (r > 0) size.triangles += std::uint64_t{def.ring_sizes[r - 1]} + def.ring_sizes[r];
    }
  } else {
    refuse("kind is " + std::to_string(def.kind) + ", must be PLEAT_SHAPE_GRID or PLEAT_SHAPE_RINGS");
  }
  need_size(size.vertices, size.triangles);
  return size;
}

Mesh make(const pleat_shape_def& def) {
  if (def.kind == PLEAT_SHAPE_GRID) {
    return make_grid({def.rows, def.columns, def.width, def.depth, def.alternate != 0});
  }
  std::vector<Ring> rings(def.ring_count);
  for (std::uint32_t r = 0; r < def.ring_count; ++r) {
    rings[r] = {def.ring_sizes[r], def.ring_radii[r], def.ring_heights[r]};
  }
  return make_rings(rings);
}

std::vector<Triangle> read_triangles(const std::uint32_t* triangles, std::uint32_t count, std::uint32_t vertex_count) {
  need_pointer("triangles", triangles);
  std::vector<Triangle> read(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      read[t][k] = triangles[3 * t + k];
      need_index("triangles", t, k, read[t][k], vertex_count);
    }
  }
  return read;
}

void need_pins(const std::uint32_t* pins, std::uint32_t count, std::uint32_t vertex_count) {
  if (count == 0) return;
  need_pointer("pins", pins);
  std::vector<bool> seen(vertex_count, false);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::string name = "pins[" + std::to_string(k) + "] is " + std::to_string(pins[k]);
    if (pins[k] >= vertex_count) refuse(name + ", there are " + std::to_string(vertex_count) + " vertices");
    if (seen[pins[k]]) refuse(name + ", a second time");
    seen[pins[k]] = true;
  }
}

std::vector<std::array<std::uint32_t, 2>> read_seams(const pleat_garment_def& def) {
  if (def.seam_count == 0) return {};
  need_pointer("seams", def.seams);
  need_range("seam_count", def.seam_count, 0, 3 * PLEAT_MAX_TRIANGLES);
  std::vector<std::array<std::uint32_t, 2>> seams(def.seam_count);
  for (std::uint32_t s = 0; s < def.seam_count; ++s) {
    for (std::size_t k = 0; k < 2; ++k) {
      seams[s][k] = def.seams[2 * s + k];
      need_index("seams", s, k, seams[s][k], def.vertex_count);
    }
  }
  return seams;
}

/// Empty where the host gives none.
std::span<const float> need_masses(const float* masses, std::uint32_t vertex_count) {
  if (masses == nullptr) return {};
  for (std::uint32_t i = 0; i < vertex_count; ++i) {
    if (!(masses[i] >= 0.0f && masses[i] <= 1e3f)) {
      refuse("added_mass[" + std::to_string(i) + "] is " + text(masses[i]) + ", must be from 0 to 1000");
    }
  }
  return {masses, vertex_count};
}

void write_report(const MeshReport& from, pleat_mesh_report* to) {
  if (to == nullptr) return;
  const pleat_mesh_report all{.size = sizeof all,
                              .degenerate_triangles = from.degenerate_triangles,
                              .duplicate_triangles = from.duplicate_triangles,
                              .flipped_triangles = from.flipped_triangles,
                              .unreferenced_vertices = from.unreferenced_vertices,
                              .nonmanifold_edges = from.nonmanifold_edges,
                              .nonorientable_edges = from.nonorientable_edges,
                              .nonmanifold_vertices = from.nonmanifold_vertices,
                              .parts = from.parts,
                              .border_loops = from.border_loops};
  write_sized("report", to, all);
}

void log_repairs(const World& world, const MeshReport& r) {
  std::string line;
  const auto add = [&](std::uint32_t count, const char* what) {
    if (count != 0) line += (line.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(r.degenerate_triangles, "degenerate triangles left out");
  add(r.duplicate_triangles, "duplicate triangles left out");
  add(r.flipped_triangles, "triangles turned to their neighbours' winding");
  add(r.unreferenced_vertices, "vertices without a triangle carried along");
  add(r.nonmanifold_vertices, "vertices where two fans touch");
  if (!line.empty()) world.log(PLEAT_LOG_WARNING, "garment_create: mesh repaired: " + line);
}

}  // namespace

pleat_result shape_def_init(pleat_shape_def* def, size_t size) {
  return init_def("shape_def_init", def, size, default_shape());
}

pleat_result shape_size(const pleat_shape_def* given, uint32_t* vertex_count, uint32_t* triangle_count) {
  return guarded(nullptr, "shape_size", [&] {
    const Size size = measure(read_def("def", given, default_shape()));
    need_pointer("vertex_count", vertex_count);
    need_pointer("triangle_count", triangle_count);
    *vertex_count = static_cast<uint32_t>(size.vertices);
    *triangle_count = static_cast<uint32_t>(size.triangles);
  });
}

pleat_result shape_build(const pleat_shape_def* given, float* positions, uint32_t* triangles) {
  return guarded(nullptr, "shape_build", [&] {
    const pleat_shape_def def = read_def("def", given, default_shape());
    measure(def);
    need_pointer("positions", positions);
    need_pointer("triangles", triangles);
    const Mesh mesh = make(def);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) std::memcpy(positions + 3 * i, &mesh.positions[i], 12);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) std::memcpy(triangles + 3 * t, &mesh.triangles[t], 12);
  });
}

pleat_result garment_def_init(pleat_garment_def* def, size_t size) {
  return init_def("garment_def_init", def, size, default_garment());
}

pleat_result garment_create(pleat_world* handle, const pleat_garment_def* given, pleat_mesh_report* report,
                            pleat_garment* garment) {
  return guarded(as_world(handle), "garment_create", [&] {
    World& world = need_world(handle);
    need_pointer("garment", garment);
    if (report != nullptr) need_sized("report", report);
    const pleat_garment_def def = read_def("def", given, default_garment());
    if (def.vertex_count < 3) refuse("vertex_count is " + std::to_string(def.vertex_count) + ", at least 3 are needed");
    if (def.triangle_count == 0) refuse("triangle_count is 0");
    need_size(def.vertex_count, def.triangle_count);
    const HostVectors host("positions", def.positions, def.position_stride, def.vertex_count);
    std::vector<Vec3> positions(def.vertex_count);
    for (std::uint32_t i = 0; i < def.vertex_count; ++i) positions[i] = host[i];
    std::vector<Triangle> triangles = read_triangles(def.triangles, def.triangle_count, def.vertex_count);
    need_pins(def.pins, def.pin_count, def.vertex_count);

    std::vector<float> uvs;
    if (def.uvs != nullptr) {
      const HostVectors given_uvs("uvs", def.uvs, def.uv_stride, def.vertex_count, 2);
      uvs.resize(2 * std::size_t{def.vertex_count});
      for (std::size_t i = 0; i < def.vertex_count; ++i) {
        std::memcpy(&uvs[2 * i], given_uvs.at(i), 2 * sizeof(float));
      }
    }
    const std::vector<std::array<std::uint32_t, 2>> seams = read_seams(def);
    need_range("crease_angle", def.crease_angle, 0, std::numbers::pi);

    const MeshReport found = check_and_repair(positions, triangles);
    write_report(found, report);
    if (!found.fault.empty()) refuse("the mesh cannot be cloth: " + found.fault, PLEAT_ERROR_MESH);
    log_repairs(world, found);
    const GarmentInput input{.positions = positions,
                             .triangles = triangles,
                             .uvs = uvs,
                             .pins = {def.pins, def.pin_count},
                             .seams = seams,
                             .crease_angle = def.crease_angle,
                             .added_mass = need_masses(def.added_mass, def.vertex_count)};
    Garment built = build_garment(input, &world.memory);
    if (!seams.empty() && built.crease_count == 0) {
      world.log(PLEAT_LOG_WARNING, "garment_create: none of the " + std::to_string(seams.size()) +
                                       " seams is an edge between two triangles");
    }
    const Handle added = add_garment(world, std::move(built));
    *garment = {added.index, added.generation};
  });
}

pleat_result garment_destroy(pleat_world* handle, pleat_garment garment) {
  return guarded(as_world(handle), "garment_destroy", [&] {
    World& world = need_world(handle);
    const std::uint32_t position = need_handle("garment", world.garment_handles, garment);
    const std::uint32_t users = world.garments[position]->users;
    if (users != 0) refuse("garment is still worn by " + std::to_string(users) + " cloths: destroy them first");
    remove_garment(world, position);
  });
}

pleat_result garment_info(const pleat_world* handle, pleat_garment garment, pleat_garment_info* info) {
  return guarded(as_world(handle), "garment_info", [&] {
    const Garment& g = need_garment(need_world(handle), garment).garment;
    const pleat_garment_info all{.size = sizeof all,
                                 .particles = g.particle_count,
                                 .triangles = g.face_count,
                                 .edges = g.edge_count,
                                 .border_edges = g.border_edge_count,
                                 .hinges = g.hinge_count,
                                 .pins = static_cast<uint32_t>(g.pins.size()),
                                 .area = g.area};
    write_sized("info", info, all);
  });
}

pleat_result garment_read_triangles(const pleat_world* handle, pleat_garment garment, uint32_t* triangles,
                                    uint32_t capacity) {
  return guarded(as_world(handle), "garment_read_triangles", [&] {
    const Garment& g = need_garment(need_world(handle), garment).garment;
    need_pointer("triangles", triangles);
    need_capacity("capacity", capacity, g.face_count);
    for (std::uint32_t f = 0; f < g.face_count; ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) triangles[3 * f + k] = g.face_particle[k][f];
    }
  });
}

pleat_result garment_read_edges(const pleat_world* handle, pleat_garment garment, uint32_t* particles,
                                float* rest_lengths, uint32_t capacity) {
  return guarded(as_world(handle), "garment_read_edges", [&] {
    const Garment& g = need_garment(need_world(handle), garment).garment;
    need_capacity("capacity", capacity, g.edge_count);
    for (std::uint32_t e = 0; e < g.edge_count; ++e) {
      if (particles != nullptr) particles[2 * e] = g.edge_particle[0][e], particles[2 * e + 1] = g.edge_particle[1][e];
      if (rest_lengths != nullptr) rest_lengths[e] = g.edge_rest_length[e];
    }
  });
}

}  // namespace pleat::call
