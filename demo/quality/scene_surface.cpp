#include "demo/quality/scene_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "demo/scenes/scene.h"

namespace pleat::demo {
namespace {

constexpr double kSettle = 1.0, kWatch = 2.0;  // s
constexpr double kOnEdge = 1e-4;               // of the edge's length: nearer than this is on it

using Vertex = DrawnSurface::Vertex;

Vector3d place(const float* position) { return {position[0], position[1], position[2]}; }

/// Drawn vertices sorted by x, so that those near an edge need not be looked for among all.
std::vector<uint32_t> sorted_by_x(std::span<const Vertex> drawn) {
  std::vector<uint32_t> order(drawn.size());
  for (uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  std::ranges::sort(order, {}, [&](uint32_t v) { return drawn[v].position[0]; });
  return order;
}

/// Those of the flat surface's vertices that lie on the segment ab, from a to b; one of each place.
std::vector<uint32_t> vertices_on(const Vector3d& a, const Vector3d& b, std::span<const Vertex> drawn,
                                  std::span<const uint32_t> by_x) {
  const double length = (b - a).norm(), tolerance = kOnEdge * length;
  const auto x = [&](uint32_t v) { return double(drawn[v].position[0]); };
  const auto [low, high] = std::minmax(a.x(), b.x());
  const auto first = std::ranges::lower_bound(by_x, low - tolerance, {}, x);
  const auto last = std::ranges::upper_bound(by_x, high + tolerance, {}, x);
  std::vector<std::pair<double, uint32_t>> found;  // by distance from a
  for (auto v = first; v != last; ++v) {
    const Vector3d p = place(drawn[*v].position);
    if ((p - nearest_on_segment(p, a, b)).norm() < tolerance) found.emplace_back((p - a).norm(), *v);
  }
  std::ranges::sort(found);
  std::vector<uint32_t> chain;
  double reached = -length;
  for (const auto& [distance, v] : found) {
    if (distance - reached > tolerance) chain.push_back(v);
    reached = distance;
  }
  return chain;
}

/// The garment alone, as it was cut.
SceneDef at_rest(SceneDef def, uint32_t surface) {
  def.settings.surface = surface;
  def.motion = {};
  def.body = {};
  def.fixed.clear();
  return def;
}

DrawnSurface drawing(const Scene& scene) {
  DrawnSurface drawn = make_surface(scene, 0);
  read_vertices(scene, 0, drawn);
  return drawn;
}

}  // namespace

SurfaceMesh surface_mesh(const pleat_api& api, const SceneDef& def) {
  const Scene rest(api, at_rest(def, PLEAT_SURFACE_FLAT));
  pleat_garment_info info{};
  info.size = sizeof info;
  rest.check(api.garment_info(rest.world(), rest.garment(), &info), "garment");
  SurfaceMesh mesh{};
  std::vector<uint32_t> ends(2 * size_t(info.edges));
  mesh.triangles.resize(3 * size_t(info.triangles));
  rest.check(api.garment_read_edges(rest.world(), rest.garment(), ends.data(), nullptr, info.edges), "edges");
  rest.check(
      api.garment_read_triangles(rest.world(), rest.garment(), mesh.triangles.data(), uint32_t(mesh.triangles.size())),
      "triangles");

  const DrawnSurface flat = drawing(rest);
  const bool curved = api.features & PLEAT_FEATURE_SMOOTHING;
  const DrawnSurface round = curved ? drawing(Scene(api, at_rest(def, PLEAT_SURFACE_PN))) : flat;
  std::vector<float> particles;
  rest.read_particles(0, particles);
  const std::vector<uint32_t> by_x = sorted_by_x(flat.vertices);
  for (size_t e = 0; e < info.edges; ++e) {
    const Vector3d a = place(&particles[3 * ends[2 * e]]), b = place(&particles[3 * ends[2 * e + 1]]);
    mesh.edges.push_back(vertices_on(a, b, flat.vertices, by_x));
    mesh.rest_lengths.push_back(chain_length(round.vertices, mesh.edges.back()));
  }
  mesh.rest_area = surface_area(round.vertices, flat.indices);
  mesh.drawn_triangles = flat.indices;
  return mesh;
}

SceneSurface measure_surface(const pleat_api& api, const SceneDef& def, const std::function<void()>& step) {
  const SurfaceMesh mesh = surface_mesh(api, def);
  Scene scene(api, def);
  DrawnSurface drawn = make_surface(scene, 0);
  std::vector<float> particles;
  const auto watch = [&](SurfaceMotionMeter& meter) {
    scene.read_particles(0, particles);
    read_vertices(scene, 0, drawn);
    meter.add_frame(particles, drawn.vertices);
  };

  SurfaceMotionMeter moving(mesh);
  while (scene.frame() < def.frames) {
    scene.advance();
    watch(moving);
    step();
  }
  if (!def.motion) return {moving.result(), std::nullopt};

  SurfaceMotionMeter resting(mesh);
  const long settled = std::lround(kSettle * def.rate), end = settled + std::lround(kWatch * def.rate);
  for (long frame = 0; frame < end; ++frame) {
    scene.hold();
    if (frame >= settled) watch(resting);
  }
  return {moving.result(), resting.result()};
}

}  // namespace pleat::demo
