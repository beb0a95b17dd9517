#include "systems/drawn_normals.h"

#include <algorithm>

#include "components/base_normal.h"
#include "components/wide.h"

namespace pleat {

bool DrawnNormals::validate() const { return pattern != nullptr && position.x != nullptr && normal.x != nullptr; }

void DrawnNormals::run() const {
  run_wide(widest_vectors(), [this] {
    const std::uint32_t* triangles = pattern->face_triangles.data();
    const std::size_t triangle_indices = pattern->face_triangles.size();
    const std::uint32_t vertices = pattern->vertices_per_face;
    const std::uint32_t faces = static_cast<std::uint32_t>(pattern->face_vertices.size() / vertices);

    clear(normal, pattern->shaded_count());
    Vec3Lanes x[kMaxVerticesPerFace], n[kMaxVerticesPerFace];  // a lane is a face
    for (std::uint32_t begin = 0; begin < faces; begin += kLanes) {
      const std::uint32_t count = std::min(kLanes, faces - begin);
      const std::uint32_t* drawn = pattern->face_vertices.data() + std::size_t{begin} * vertices;
      for (std::uint32_t v = 0; v < vertices; ++v) {
        std::uint32_t index[kLanes];
        for (std::uint32_t k = 0; k < kLanes; ++k) index[k] = drawn[std::size_t{std::min(k, count - 1)} * vertices + v];
        x[v] = gather(position, index);
      }
      std::fill_n(n, vertices, Vec3Lanes{});
      for (std::size_t t = 0; t < triangle_indices; t += 3) {
        const Vec3Lanes &a = x[triangles[t]], &b = x[triangles[t + 1]], &c = x[triangles[t + 2]];
        const Vec3Lanes area = cross(b - a, c - a);
        for (std::size_t k = 0; k < 3; ++k) n[triangles[t + k]] += area;
      }
      const std::uint32_t* shaded = pattern->shaded_vertices() + std::size_t{begin} * vertices;
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        const std::uint32_t* own = shaded + std::size_t{lane} * vertices;
        for (std::uint32_t v = 0; v < vertices; ++v) normal.add(own[v], {n[v].x[lane], n[v].y[lane], n[v].z[lane]});
      }
    }
    normalize(normal, pattern->shaded_count());
  });
}

}  // namespace pleat
