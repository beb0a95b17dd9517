#include "systems/drawn_normals.h"

#include <algorithm>
#include <memory>

#include "components/base_normal.h"
#include "components/lane_rows.h"

namespace pleat {
namespace {

/// Of eight faces the same.
struct FaceVertex {
  Vec3Lanes x, n;  // m; m2, sum of cross products
};
/// Not to be zeroed before they are made.
union FaceVertices {
  FaceVertex each[kMaxVerticesPerFace];
  FaceVertices() {}
};

/// Adds up the triangles of eight faces at their vertices; what is inside the faces is done with that.
PLEAT_KERNEL void add_faces(const DrawnNormals& s, std::uint32_t begin, std::uint32_t count) {
  const TessellationPattern& pattern = *s.pattern;
  const std::uint32_t *from = pattern.drawn_of_faces(begin), *to = pattern.shaded_of_faces(begin);
  FaceVertices vertices;
  FaceVertex* const of = vertices.each;
  for (std::uint32_t v = 0; v < pattern.vertices_per_face; ++v) {
    std::construct_at(of + v, FaceVertex{gather(s.position, from + v * kLanes), {}});
  }
  const std::uint32_t* triangles = pattern.face_triangles.data();
  for (const std::uint32_t *t = triangles, *last = t + pattern.face_triangles.size(); t != last; t += 3) {
    FaceVertex &a = of[t[0]], &b = of[t[1]], &c = of[t[2]];
    const Vec3Lanes area = cross(b.x - a.x, c.x - a.x);
    a.n += area, b.n += area, c.n += area;
  }
  const std::uint32_t inner = static_cast<std::uint32_t>(pattern.inner.size()),
                      first_inner = pattern.vertices_per_face - inner;
  for (std::uint32_t v = 0; v < first_inner; ++v) scatter_add(of[v].n, to + v * kLanes, count, s.sum);
  LaneRows rows;
  for (std::uint32_t i = 0; i < inner; ++i) rows.set(i, normalized_or(of[first_inner + i].n, all(kAnyNormal)));
  rows.store_to(s.normal, pattern.face_vertex(begin, 0), inner, count);
}

PLEAT_KERNEL void normalize_sums(const DrawnNormals& s, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; i += kLanes) {
    store(normalized_or(load(s.sum + i).vector, all(kAnyNormal)), s.normal, i, std::min(kLanes, end - i));
  }
}

}  // namespace

bool DrawnNormals::validate() const {
  return pattern != nullptr && position.x != nullptr && sum != nullptr && normal.x != nullptr;
}

void DrawnNormals::run() const {
  run_wide(widest_vectors(), [this] {
    const std::uint32_t faces = static_cast<std::uint32_t>(pattern->face_vertices.size() / pattern->vertices_per_face);
    const std::uint32_t shared = pattern->first_face_vertex, shaded = pattern->shaded_count();
    std::fill_n(sum, shared, Vec4{});
    std::fill(sum + pattern->vertex_count, sum + shaded, Vec4{});
    for (std::uint32_t f = 0; f < faces; f += kLanes) add_faces(*this, f, std::min(kLanes, faces - f));
    normalize_sums(*this, 0, shared);
    normalize_sums(*this, pattern->vertex_count, shaded);
  });
}

}  // namespace pleat
