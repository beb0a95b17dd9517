#include "components/tessellation_pattern.h"

#include <algorithm>
#include <vector>

#include "components/lanes.h"
#include "components/pn_triangle.h"

namespace pleat {
namespace {

/// A face's own numbering of its vertices, on a triangular grid of n steps a side.
struct FaceGrid {
  std::uint32_t n;

  std::uint32_t corner(std::uint32_t k) const { return k; }
  /// The vertex `step` steps along side k, from corner k on.
  std::uint32_t side(std::uint32_t k, std::uint32_t step) const { return 3 + k * (n - 1) + step - 1; }
  std::uint32_t inner(std::uint32_t index) const { return 3 * n + index; }

  /// The grid point j steps towards corner 1 and k steps towards corner 2. Inner points are numbered row by row.
  std::uint32_t at(std::uint32_t j, std::uint32_t k) const {
    const std::uint32_t i = n - j - k;
    if (i == n) return corner(0);
    if (j == n) return corner(1);
    if (k == n) return corner(2);
    if (k == 0) return side(0, j);
    if (i == 0) return side(1, k);
    if (j == 0) return side(2, i);
    return inner((k - 1) * (n - 1) - (k - 1) * k / 2 + j - 1);
  }
};

/// How the folds over the three edges reach into the face: each of the four patches is given the cubic height field
/// whose control points at and next to an edge's middle are raised by one, so that it joins its neighbours and is
/// fold_shape() on the sides.  S_i = l_i^2 (3 - 2 l_i) + 2 l_0 l_1 l_2 at the patch's corner i, l = local.
void set_fold_shares(InnerPoint& p) {
  const float* l = p.local;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const float share = l[i] * l[i] * (3.0f - 2.0f * l[i]) + 2.0f * l[0] * l[1] * l[2];
    if (p.patch == 3) {
      p.fold[i] = share;
    } else if (i > 0) {
      p.fold[(p.patch + (i == 1 ? 0 : 2)) % 3] = share;
    }
  }
}

/// a, b, c: barycentrics in the face, as counts of 1/n.
InnerPoint inner_point(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t n) {
  const auto part = [n](std::uint32_t count) { return static_cast<float>(count) / static_cast<float>(n); };
  const std::uint32_t count[3] = {a, b, c};
  InnerPoint p{.patch = 3, .local = {}, .face = {part(a), part(b), part(c)}, .bend = {}, .fold = {}};
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (2 * count[k] >= n) p.patch = k;
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (p.patch == 3) {
      p.local[k] = part(n - 2 * count[(k + 2) % 3]);
    } else {
      p.local[k] = part(2 * count[(p.patch + k) % 3] - (k == 0 ? n : 0));
    }
  }
  p.bend = bend_weights(p.face);
  set_fold_shares(p);
  return p;
}

void add(Column<std::uint32_t>& triangles, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles.push_back(a), triangles.push_back(b), triangles.push_back(c);
}

void add_fan(Column<std::uint32_t>& triangles) {
  const FaceGrid face{4};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t before = (k + 2) % 3, across = face.inner(k), center = face.inner(3);
    const std::uint32_t next = face.side(k, 1), next_middle = face.side(k, 2);
    const std::uint32_t last = face.side(before, 3), last_middle = face.side(before, 2);
    add(triangles, face.corner(k), next, last);
    add(triangles, next, next_middle, across);
    add(triangles, across, last_middle, last);
    add(triangles, next, across, last);
    add(triangles, center, across, next_middle);
    add(triangles, center, last_middle, across);
  }
}

void add_grid(std::uint32_t n, Column<std::uint32_t>& triangles) {
  const FaceGrid face{n};
  for (std::uint32_t k = 0; k < n; ++k) {
    for (std::uint32_t j = 0; j + k < n; ++j) {
      add(triangles, face.at(j, k), face.at(j + 1, k), face.at(j, k + 1));
      if (j + k + 1 < n) add(triangles, face.at(j + 1, k), face.at(j + 1, k + 1), face.at(j, k + 1));
    }
  }
}

void add_inner_points(bool fan, std::uint32_t n, Column<InnerPoint>& inner) {
  if (fan) {
    inner.push_back(inner_point(2, 1, 1, 4));
    inner.push_back(inner_point(1, 2, 1, 4));
    inner.push_back(inner_point(1, 1, 2, 4));
    inner.push_back(inner_point(1, 1, 1, 3));
    return;
  }
  for (std::uint32_t k = 1; k < n; ++k) {
    for (std::uint32_t j = 1; j + k < n; ++j) inner.push_back(inner_point(n - j - k, j, k, n));
  }
}

/// The drawn vertices of face f in the face's own order.
void set_face_vertices(const Garment& garment, std::uint32_t f, TessellationPattern& pattern) {
  std::uint32_t* vertex = &pattern.face_vertices[std::size_t{f} * pattern.vertices_per_face];
  for (std::uint32_t k = 0; k < 3; ++k) *vertex++ = garment.face_particle[k][f];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t edge = garment.face_edge[k][f];
    const bool forward = garment.edge_particle[0][edge] == garment.face_particle[k][f];
    for (std::uint32_t step = 1; step < pattern.segments; ++step) {
      *vertex++ = pattern.edge_vertex(edge, forward ? step : pattern.segments - step);
    }
  }
  for (std::uint32_t i = 0; i < pattern.inner.size(); ++i) *vertex++ = pattern.face_vertex(f, i);
}

void set_face_weights(TessellationPattern& pattern) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    std::array<float, 3> corner{};
    corner[k] = 1.0f;
    pattern.face_weights.push_back(corner);
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    for (std::uint32_t step = 1; step < pattern.segments; ++step) {
      std::array<float, 3> side{};
      side[(k + 1) % 3] = static_cast<float>(step) / static_cast<float>(pattern.segments);
      side[k] = 1.0f - side[(k + 1) % 3];
      pattern.face_weights.push_back(side);
    }
  }
  for (const InnerPoint& q : pattern.inner) pattern.face_weights.push_back({q.face[0], q.face[1], q.face[2]});
}

/// Twins: at a particle one for each part of its faces but the first; along a crease one for each vertex, used by the
/// second face.
void add_twins(const Garment& g, TessellationPattern& pattern) {
  if (g.crease_count == 0) return;
  const auto add_twin = [&](std::uint32_t vertex) {
    pattern.twins.push_back(vertex);
    return pattern.shaded_count() - 1;
  };
  std::vector<std::uint32_t> of_part(g.part_particle.size()), of_crease(g.edge_count);
  for (std::size_t p = 0; p < of_part.size(); ++p) {
    const std::uint32_t i = g.part_particle[p];
    of_part[p] = p == 0 || g.part_particle[p - 1] != i ? i : add_twin(i);
  }
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    if (!g.edge_is_crease[e]) continue;
    of_crease[e] = pattern.shaded_count();
    for (std::uint32_t step = 1; step < pattern.segments; ++step) add_twin(pattern.edge_vertex(e, step));
  }

  pattern.face_shaded.resize(pattern.face_vertices.size());
  std::copy(pattern.face_vertices.begin(), pattern.face_vertices.end(), pattern.face_shaded.begin());
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    std::uint32_t* shaded = &pattern.face_shaded[std::size_t{f} * pattern.vertices_per_face];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t normal = g.face_normal[k][f], e = g.face_edge[k][f];
      if (normal >= g.particle_count) shaded[k] = of_part[normal - g.particle_count];
      if (!g.edge_is_crease[e] || g.edge_face[1][e] != f) continue;
      std::uint32_t* side = shaded + 3 + k * (pattern.segments - 1);
      for (std::uint32_t s = 0; s + 1 < pattern.segments; ++s) side[s] += of_crease[e] - pattern.edge_vertex(e, 1);
    }
  }
}

/// Rows of `vertices` numbers, one a face, as drawn_lanes and shaded_lanes have them.
void set_lanes(const Column<std::uint32_t>& rows, std::uint32_t vertices, Column<std::uint32_t>& lanes) {
  const std::size_t faces = rows.size() / vertices;
  lanes.resize((faces + kLanes - 1) / kLanes * kLanes * vertices);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const std::size_t run = i / (kLanes * vertices), vertex = i / kLanes % vertices, f = run * kLanes + i % kLanes;
    lanes[i] = rows[std::min(f, faces - 1) * vertices + vertex];
  }
}

}  // namespace

TessellationPattern build_tessellation(const Garment& garment, std::uint32_t level, std::pmr::memory_resource* memory) {
  TessellationPattern pattern(memory);
  const bool fan = level == 0;
  pattern.level = level;
  pattern.segments = fan ? 4 : 2 * level;
  add_inner_points(fan, pattern.segments, pattern.inner);
  fan ? add_fan(pattern.face_triangles) : add_grid(pattern.segments, pattern.face_triangles);

  pattern.first_edge_vertex = garment.particle_count;
  pattern.first_face_vertex = pattern.first_edge_vertex + garment.edge_count * (pattern.segments - 1);
  pattern.vertex_count = pattern.face_vertex(garment.face_count, 0);
  pattern.vertices_per_face = 3 * pattern.segments + static_cast<std::uint32_t>(pattern.inner.size());
  const std::size_t indices_per_face = pattern.face_triangles.size();
  pattern.triangle_count = garment.face_count * static_cast<std::uint32_t>(indices_per_face / 3);

  pattern.face_vertices.resize(std::size_t{garment.face_count} * pattern.vertices_per_face);
  pattern.indices.resize(garment.face_count * indices_per_face);
  set_face_weights(pattern);
  for (std::uint32_t f = 0; f < garment.face_count; ++f) set_face_vertices(garment, f, pattern);
  add_twins(garment, pattern);
  set_lanes(pattern.face_vertices, pattern.vertices_per_face, pattern.drawn_lanes);
  if (pattern.twins.size() != 0) set_lanes(pattern.face_shaded, pattern.vertices_per_face, pattern.shaded_lanes);
  for (std::uint32_t f = 0; f < garment.face_count; ++f) {
    const std::uint32_t* vertex = pattern.shaded_vertices() + std::size_t{f} * pattern.vertices_per_face;
    for (std::size_t i = 0; i < indices_per_face; ++i) {
      pattern.indices[f * indices_per_face + i] = vertex[pattern.face_triangles[i]];
    }
  }
  return pattern;
}

}  // namespace pleat
