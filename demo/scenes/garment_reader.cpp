#include "demo/scenes/garment_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "demo/scenes/coarsen.h"
#include "demo/scenes/cut_to_length.h"
#include "demo/scenes/obj.h"

namespace pleat::demo {
namespace {

using Eigen::Vector3d;

constexpr uint32_t kMostRings = 256, kMostOfARing = 4096;

struct Rings {
  std::vector<uint32_t> sizes;
  std::vector<float> radii, heights;
};

Vector3d vertex(const TriangleMesh& mesh, uint32_t v) {
  return {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
}

template <typename Map>
void transform(TriangleMesh& mesh, const Map& map) {
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3d moved = map(vertex(mesh, v));
    for (int axis = 0; axis < 3; ++axis) mesh.positions[3 * v + uint32_t(axis)] = float(moved[axis]);
  }
}

TriangleMesh build_shape(const JsonValue& at, const pleat_api& api, const pleat_shape_def& def) {
  uint32_t vertices = 0, triangles = 0;
  TriangleMesh mesh;
  const auto too_large = [&] {
    at.fail("the garment is too large: at most " + std::to_string(PLEAT_MAX_PARTICLES) + " particles and " +
            std::to_string(PLEAT_MAX_TRIANGLES) + " triangles");
  };
  if (api.shape_size(&def, &vertices, &triangles) != PLEAT_OK) too_large();
  if (vertices > PLEAT_MAX_PARTICLES || triangles > PLEAT_MAX_TRIANGLES) too_large();
  mesh.positions.resize(3 * vertices);
  mesh.triangles.resize(3 * triangles);
  if (api.shape_build(&def, mesh.positions.data(), mesh.triangles.data()) != PLEAT_OK) {
    at.fail("this shape cannot be built");
  }
  return mesh;
}

TriangleMesh build_rings(const JsonValue& at, const pleat_api& api, const Rings& rings) {
  pleat_shape_def def;
  api.shape_def_init(&def, sizeof def);
  def.kind = PLEAT_SHAPE_RINGS;
  def.ring_count = uint32_t(rings.sizes.size());
  def.ring_sizes = rings.sizes.data();
  def.ring_radii = rings.radii.data();
  def.ring_heights = rings.heights.data();
  return build_shape(at, api, def);
}

TriangleMesh read_grid(const JsonValue& grid, const pleat_api& api) {
  grid.allow_keys({"rows", "columns", "width", "depth", "center"});
  pleat_shape_def def;
  api.shape_def_init(&def, sizeof def);
  def.kind = PLEAT_SHAPE_GRID;
  def.rows = grid.at("rows").integer(2, 4096);
  def.columns = grid.at("columns").integer(2, 4096);
  if (const auto width = grid.find("width")) def.width = float(width->number(1e-3, 1e3));
  if (const auto depth = grid.find("depth")) def.depth = float(depth->number(1e-3, 1e3));
  TriangleMesh mesh = build_shape(grid, api, def);
  if (const auto center = grid.find("center")) {
    transform(mesh, [move = center->vector()](const Vector3d& p) { return p + move; });
  }
  return mesh;
}

Rings read_rings(const JsonValue& list) {
  Rings rings;
  for (const JsonValue& ring : list.items()) {
    ring.allow_keys({"size", "radius", "height"});
    rings.sizes.push_back(ring.at("size").integer(3, kMostOfARing));
    rings.radii.push_back(float(ring.at("radius").number(1e-3, 1e3)));
    rings.heights.push_back(float(ring.at("height").number(-1e3, 1e3)));
  }
  if (rings.sizes.size() < 2 || rings.sizes.size() > kMostRings) list.fail("needs 2 to 256 rings");
  return rings;
}

std::vector<uint32_t> read_ring_sizes(const JsonValue& skirt) {
  skirt.allow_keys({"ring_sizes"});
  std::vector<uint32_t> sizes;
  for (const JsonValue& size : skirt.at("ring_sizes").items()) sizes.push_back(size.integer(3, kMostOfARing));
  if (sizes.size() < 2 || sizes.size() > kMostRings) skirt.at("ring_sizes").fail("needs 2 to 256 rings");
  return sizes;
}

/// A skirt with the proportions of workload W1, cut for a body: from the waist, clear of it, to the knees.
Rings cut_skirt(std::vector<uint32_t> sizes, const Figure& figure) {
  constexpr double kClearance = 0.02;  // m, outside the waist: cloth thickness, and ease for a torso that bends
  constexpr double kFlare = 0.42;      // growth of the radius by length
  constexpr double kHem = 0.42;        // below the hip joints, by leg length; the knee is at about 0.5
  Rings rings{std::move(sizes), {}, {}};
  const size_t count = rings.sizes.size();
  const double waist = (figure.waist_radius + kClearance) / std::cos(std::numbers::pi / rings.sizes[0]);
  const double length = figure.waist_height + kHem * figure.leg_length;
  for (size_t r = 0; r < count; ++r) {
    const double drop = length * double(r) / double(count - 1);
    rings.radii.push_back(float(waist + kFlare * drop));
    rings.heights.push_back(float(figure.waist_height - drop));
  }
  return rings;
}

std::vector<uint32_t> pins_in(const JsonValue& pins, const TriangleMesh& mesh, const auto& holds) {
  std::vector<uint32_t> found;
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (holds(vertex(mesh, v))) found.push_back(v);
  }
  if (found.empty()) pins.fail("holds no vertex of the garment");
  return found;
}

/// `ring_sizes` is empty for garments that are not made of rings.
std::vector<uint32_t> read_pins(const JsonValue& pins, const TriangleMesh& mesh, std::span<const uint32_t> ring_sizes) {
  pins.allow_keys({"vertices", "ring", "above", "box"});
  const std::string kind = pins.one_of({"vertices", "ring", "above", "box"});
  const JsonValue value = pins.at(kind);
  if (kind == "above") {
    return pins_in(pins, mesh, [y = value.number(-1e4, 1e4)](const Vector3d& p) { return p.y() > y; });
  }
  if (kind == "box") {
    value.allow_keys({"low", "high"});
    const Vector3d low = value.at("low").vector(), high = value.at("high").vector();
    return pins_in(pins, mesh, [&](const Vector3d& p) {
      return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    });
  }
  std::vector<uint32_t> found;
  if (kind == "ring") {
    if (ring_sizes.empty()) value.fail("the garment is not made of rings");
    const uint32_t ring = value.integer(0, uint32_t(ring_sizes.size()) - 1);
    uint32_t first = 0;
    for (uint32_t r = 0; r < ring; ++r) first += ring_sizes[r];
    for (uint32_t i = 0; i < ring_sizes[ring]; ++i) found.push_back(first + i);
    return found;
  }
  for (const JsonValue& index : value.items()) found.push_back(index.integer(0, uint32_t(mesh.vertex_count()) - 1));
  std::ranges::sort(found);
  if (std::ranges::adjacent_find(found) != found.end()) value.fail("names a vertex twice");
  return found;
}

/// As it is in the file, `scale`, `up` and `move` done.
TriangleMesh read_whole_mesh(const JsonValue& value, const SceneFile& file) {
  value.allow_keys({"file", "scale", "up", "move", "vertices"});
  const std::string name = value.at("file").text();
  const double scale = value.find("scale") ? value.at("scale").number(1e-6, 1e6) : 1.0;
  const Vector3d move = value.find("move") ? value.at("move").vector() : Vector3d::Zero();
  const std::string up = value.find("up") ? value.at("up").text() : "y";
  if (up != "y" && up != "z") value.at("up").fail("should be `y` or `z`, is `" + up + "`");
  TriangleMesh mesh = read_obj(*file.open(name), file.path_of(name));
  transform(mesh, [&](const Vector3d& p) -> Vector3d {
    return scale * (up == "z" ? Vector3d(p.x(), p.z(), -p.y()) : p) + move;
  });
  return mesh;
}

TriangleMesh coarsened(const JsonValue& value, const TriangleMesh& mesh) {
  const auto vertices = value.find("vertices");
  return vertices ? coarsen(mesh, vertices->integer(3, PLEAT_MAX_PARTICLES)) : mesh;
}

TriangleMesh read_garment_mesh(const JsonValue& value, const SceneFile& file) {
  const TriangleMesh fine = read_whole_mesh(value, file);
  TriangleMesh coarse = coarsened(value, fine);
  if (coarse.vertex_count() < fine.vertex_count()) cut_to_length(fine, coarse);
  return coarse;
}

}  // namespace

TriangleMesh read_mesh_file(const JsonValue& value, const SceneFile& file) {
  return coarsened(value, read_whole_mesh(value, file));
}

Garment read_garment(const JsonValue& value, const SceneFile& file, const pleat_api& api, const Wearer* wearer) {
  value.allow_keys({"grid", "rings", "skirt", "obj", "pins"});
  const std::string kind = value.one_of({"grid", "rings", "skirt", "obj"});
  const JsonValue shape = value.at(kind);
  Garment garment;
  Rings rings;
  if (kind == "grid") {
    garment.mesh = read_grid(shape, api);
  } else if (kind == "rings" || kind == "skirt") {
    if (kind == "skirt" && !wearer) shape.fail("is cut for a figure: the scene needs /motion/clip");
    if (kind == "rings") rings = read_rings(shape);
    if (wearer) rings = cut_skirt(kind == "rings" ? rings.sizes : read_ring_sizes(shape), *wearer->figure);
    garment.mesh = build_rings(shape, api, rings);
    if (wearer) transform(garment.mesh, [wearer](const Vector3d& p) -> Vector3d { return wearer->hips * p; });
  } else {
    garment.mesh = read_garment_mesh(shape, file);
  }
  if (const auto pins = value.find("pins")) garment.pins = read_pins(*pins, garment.mesh, rings.sizes);
  return garment;
}

}  // namespace pleat::demo
