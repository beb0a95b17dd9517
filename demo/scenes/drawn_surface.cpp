#include "demo/scenes/drawn_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pleat::demo {

std::vector<float> DrawnSurface::positions() const {
  std::vector<float> packed;
  packed.reserve(3 * vertices.size());
  for (const Vertex& vertex : vertices) packed.insert(packed.end(), vertex.position, vertex.position + 3);
  return packed;
}

DrawnSurface make_surface(const Scene& scene, size_t cloth) {
  const pleat_cloth_info info = scene.cloth_info(cloth);
  DrawnSurface surface;
  surface.vertices.resize(info.drawn_vertices);
  surface.indices.resize(3 * size_t(info.drawn_triangles));
  scene.check(scene.api().cloth_read_indices(scene.world(), scene.cloths()[cloth], surface.indices.data(),
                                             uint32_t(surface.indices.size())),
              "drawn triangles");
  return surface;
}

void read_vertices(const Scene& scene, size_t cloth, DrawnSurface& surface) {
  using Vertex = DrawnSurface::Vertex;
  pleat_vertex_target target;
  scene.check(scene.api().vertex_target_init(&target, sizeof target), "drawn vertices");
  target.data = surface.vertices.data();
  target.stride = uint32_t(sizeof(Vertex));
  target.capacity = uint32_t(surface.vertices.size());
  target.position_offset = uint32_t(offsetof(Vertex, position));
  target.normal_offset = uint32_t(offsetof(Vertex, normal));
  scene.check(scene.api().cloth_read_vertices(scene.world(), scene.cloths()[cloth], &target), "drawn vertices");
}

bool all_finite(const DrawnSurface& surface) {
  const auto finite = [](float value) { return std::isfinite(value); };
  return std::ranges::all_of(surface.vertices, [&](const DrawnSurface::Vertex& vertex) {
    return std::ranges::all_of(vertex.position, finite) && std::ranges::all_of(vertex.normal, finite);
  });
}

SurfaceTopology inspect_topology(std::span<const uint32_t> triangles) {
  std::vector<std::pair<uint32_t, uint32_t>> directed;
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k) directed.emplace_back(triangles[t + k], triangles[t + (k + 1) % 3]);
  }
  std::ranges::sort(directed);
  const bool each_once = std::ranges::adjacent_find(directed) == directed.end();
  const auto is_border = [&](const auto& edge) {
    return !std::ranges::binary_search(directed, std::pair(edge.second, edge.first));
  };
  const auto border_edges = size_t(std::ranges::count_if(directed, is_border));
  return {border_edges, each_once};
}

}  // namespace pleat::demo
