#include "systems/drawn_normals.h"

#include <algorithm>

#include "components/base_normal.h"
#include "components/wide.h"

namespace pleat {

bool DrawnNormals::validate() const {
  return pattern != nullptr && position.x != nullptr && sum != nullptr && normal.x != nullptr;
}

void DrawnNormals::run() const {
  run_wide(widest_vectors(), [this] {
    const std::uint32_t* triangles = pattern->face_triangles.data();
    const std::uint32_t* last = triangles + pattern->face_triangles.size();
    const std::uint32_t end = pattern->vertices_per_face * kLanes, shaded = pattern->shaded_count();
    const std::uint32_t faces = static_cast<std::uint32_t>(pattern->face_vertices.size() / pattern->vertices_per_face);

    std::fill_n(sum, shaded, Vec4{});
    constexpr std::size_t kRoom = kMaxVerticesPerFace * kLanes;
    alignas(Lanes) float columns[6][kRoom];  // a lane is a face
    const Vec3View x{columns[0], columns[1], columns[2]}, n{columns[3], columns[4], columns[5]};
    for (std::uint32_t begin = 0; begin < faces; begin += kLanes) {
      const std::uint32_t* from = pattern->drawn_of_faces(begin);
      for (std::uint32_t v = 0; v < end; v += kLanes) store(gather(position, from + v), x, v), store({}, n, v);
      for (const std::uint32_t* t = triangles; t != last; t += 3) {
        const Vec3Lanes a = load(x, t[0] * kLanes), b = load(x, t[1] * kLanes), c = load(x, t[2] * kLanes);
        const Vec3Lanes area = cross(b - a, c - a);
        for (std::size_t k = 0; k < 3; ++k) store(load(n, t[k] * kLanes) + area, n, t[k] * kLanes);
      }
      const std::uint32_t *to = pattern->shaded_of_faces(begin), count = std::min(kLanes, faces - begin);
      for (std::uint32_t v = 0; v < end; v += kLanes) scatter_add(load(n, v), to + v, count, sum);
    }
    for (std::uint32_t i = 0; i < shaded; i += kLanes) {
      store(normalized_or(load(sum + i).vector, all(kAnyNormal)), normal, i, std::min(kLanes, shaded - i));
    }
  });
}

}  // namespace pleat
