#include "systems/tessellation.h"

#include <algorithm>

#include "components/arc_pn.h"
#include "components/projected_triangle.h"
#include "components/vec3_block.h"
#include "components/wide.h"

namespace pleat {
namespace {

void draw_flat(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const Vec3 a = s.position[g.edge_particle[0][e]], d = s.position[g.edge_particle[1][e]] - a;
    for (std::uint32_t step = 1; step < pattern.segments; ++step) {
      const float t = static_cast<float>(step) / static_cast<float>(pattern.segments);
      s.drawn_position.set(pattern.edge_vertex(e, step), a + d * t);
    }
  }
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const Vec3 a = s.position[g.face_particle[0][f]], b = s.position[g.face_particle[1][f]],
               c = s.position[g.face_particle[2][f]];
    std::uint32_t vertex = pattern.face_vertex(f, 0);
    for (const InnerPoint& q : pattern.inner) {
      s.drawn_position.set(vertex++, a * q.face[0] + b * q.face[1] + c * q.face[2]);
    }
  }
}

PnEdge pn_edge(const Tessellation& s, std::uint32_t e) {
  const std::uint32_t i = s.garment->edge_particle[0][e], j = s.garment->edge_particle[1][e];
  return {s.position[i], s.position[j], s.normal[i], s.normal[j]};
}

template <SurfaceMode mode>
PnEdge curved_edge(const Vec3& a, const Vec3& b, const Vec3& na, const Vec3& nb) {
  return mode == SurfaceMode::kArcPn ? arc_edge(a, b, na, nb) : PnEdge(a, b, na, nb);
}

/// kPn, kArcPn, and with folds kPleat: the vertices on edges.
template <SurfaceMode mode>
void draw_curved_edges(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  for (std::uint32_t begin = 0; begin < g.edge_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - begin);
    Vec3Block a, b, na, nb, moved{}, x;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t e = begin + std::min(lane, count - 1);
      const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
      a.set(lane, s.position[i]), na.set(lane, s.normal[g.edge_normal[0][e]]);
      b.set(lane, s.position[j]), nb.set(lane, s.normal[g.edge_normal[1][e]]);
      if constexpr (mode == SurfaceMode::kPleat) moved.set(lane, s.fold[e] * s.fold_height[e]);
    }
    for (std::uint32_t step = 1; step < pattern.segments; ++step) {
      const float t = static_cast<float>(step) / static_cast<float>(pattern.segments);
      const float share = fold_shape(t);
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const PnEdge edge = curved_edge<mode>(a[lane], b[lane], na[lane], nb[lane]);
        x.set(lane, edge.point(t) + moved[lane] * share);
      }
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        s.drawn_position.set(pattern.edge_vertex(begin + lane, step), x[lane]);
      }
    }
  }
}

/// The sides of face f that are creases bend as the edges do, not as the face's own normals say.
template <SurfaceMode mode>
void bend_along_creases(const Tessellation& s, std::uint32_t f, std::uint32_t lane, Vec3Block (&bend)[6]) {
  const Garment& g = *s.garment;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t e = g.face_edge[k][f];
    if (!g.edge_is_crease[e]) continue;
    const std::size_t first = g.edge_particle[0][e] == g.face_particle[k][f] ? 0 : 1, last = 1 - first;
    const PnEdge side = curved_edge<mode>(s.position[g.edge_particle[first][e]], s.position[g.edge_particle[last][e]],
                                          s.normal[g.edge_normal[first][e]], s.normal[g.edge_normal[last][e]]);
    bend[2 * k].set(lane, side.u), bend[2 * k + 1].set(lane, side.v);
  }
}

/// kPn, kArcPn, and with folds kPleat: the vertices inside faces.
template <SurfaceMode mode>
void draw_curved_faces(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  for (std::uint32_t begin = 0; begin < g.face_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - begin);
    Vec3Block corner[3], normal[3], bend[6], moved[3]{}, x;
    bool any_fold = false;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t f = begin + std::min(lane, count - 1);
      for (std::uint32_t k = 0; k < 3; ++k) {
        corner[k].set(lane, s.position[g.face_particle[k][f]]);
        normal[k].set(lane, s.normal[g.face_normal[k][f]]);
        if constexpr (mode == SurfaceMode::kPleat) {
          const std::uint32_t e = g.face_edge[k][f];
          if (s.fold_height[e] == 0.0f) continue;
          moved[k].set(lane, s.fold[e] * s.fold_height[e]);
          any_fold = true;
        }
      }
    }
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Vec3 p[3] = {corner[0][lane], corner[1][lane], corner[2][lane]};
      const Vec3 n[3] = {normal[0][lane], normal[1][lane], normal[2][lane]};
      const PnTriangle face = mode == SurfaceMode::kArcPn ? arc_triangle(p, n) : PnTriangle(p, n);
      for (std::size_t i = 0; i < 6; ++i) bend[i].set(lane, face.bend[i]);
    }
    if (g.crease_count != 0) {
      for (std::uint32_t lane = 0; lane < count; ++lane) bend_along_creases<mode>(s, begin + lane, lane, bend);
    }
    for (std::uint32_t i = 0; i < pattern.inner.size(); ++i) {
      const InnerPoint& q = pattern.inner[i];
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        PnTriangle face;
        for (std::size_t k = 0; k < 3; ++k) face.corner[k] = corner[k][lane];
        for (std::size_t k = 0; k < 6; ++k) face.bend[k] = bend[k][lane];
        x.set(lane, face.point(q.face, q.bend));
      }
      if (any_fold) {
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
          x.set(lane, x[lane] + (moved[0][lane] * q.fold[0] + moved[1][lane] * q.fold[1] + moved[2][lane] * q.fold[2]));
        }
      }
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        s.drawn_position.set(pattern.face_vertex(begin + lane, i), x[lane]);
      }
    }
  }
}

template <SurfaceMode mode>
void draw_curved(const Tessellation& s) {
  draw_curved_edges<mode>(s);
  draw_curved_faces<mode>(s);
}

using LiftedPoint = Vec3 (*)(const Vec3 (&)[3], const Vec3 (&)[3], const float (&)[3]);

/// kPhong, kSpherigon.
template <LiftedPoint point>
void draw_lifted(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  Vec3Block p[3], n[3], x;
  const auto gather = [&](std::uint32_t lane, std::size_t corner, std::uint32_t i) {
    p[corner].set(lane, s.position[i]), n[corner].set(lane, s.normal[i]);
  };
  const auto lift = [&](const float(&weight)[3]) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      x.set(lane, point({p[0][lane], p[1][lane], p[2][lane]}, {n[0][lane], n[1][lane], n[2][lane]}, weight));
    }
  };
  for (std::uint32_t begin = 0; begin < g.edge_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - begin);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t e = begin + std::min(lane, count - 1);
      for (std::size_t k = 0; k < 3; ++k) gather(lane, k, g.edge_particle[k % 2][e]);  // the third has weight 0
    }
    for (std::uint32_t step = 1; step < pattern.segments; ++step) {
      const float t = static_cast<float>(step) / static_cast<float>(pattern.segments);
      lift({1.0f - t, t, 0.0f});
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        s.drawn_position.set(pattern.edge_vertex(begin + lane, step), x[lane]);
      }
    }
  }
  for (std::uint32_t begin = 0; begin < g.face_count; begin += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - begin);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t f = begin + std::min(lane, count - 1);
      for (std::size_t k = 0; k < 3; ++k) gather(lane, k, g.face_particle[k][f]);
    }
    for (std::uint32_t i = 0; i < pattern.inner.size(); ++i) {
      lift(pattern.inner[i].face);
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        s.drawn_position.set(pattern.face_vertex(begin + lane, i), x[lane]);
      }
    }
  }
}

void draw_paper(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  const auto moved_middle = [&](std::uint32_t e) { return pn_edge(s, e).middle() + s.fold[e] * s.fold_height[e]; };

  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    const Vec3 middle = moved_middle(e);
    const PnEdge first(s.position[i], middle, s.normal[i], s.fold[e]);
    const PnEdge second(middle, s.position[j], s.fold[e], s.normal[j]);
    const std::uint32_t half = pattern.segments / 2;
    for (std::uint32_t step = 1; step < pattern.segments; ++step) {
      const float t = static_cast<float>(step < half ? step : step - half) / static_cast<float>(half);
      s.drawn_position.set(pattern.edge_vertex(e, step), (step < half ? first : second).point(t));
    }
  }
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    Vec3 corner[3], corner_normal[3], middle[3], middle_normal[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      corner[k] = s.position[g.face_particle[k][f]];
      corner_normal[k] = s.normal[g.face_particle[k][f]];
      middle[k] = moved_middle(g.face_edge[k][f]);
      middle_normal[k] = s.fold[g.face_edge[k][f]];
    }
    const auto corner_patch = [&](std::uint32_t k) {
      const std::uint32_t l = (k + 2) % 3;
      return PnTriangle({corner[k], middle[k], middle[l]}, {corner_normal[k], middle_normal[k], middle_normal[l]});
    };
    const PnTriangle patch[4] = {corner_patch(0), corner_patch(1), corner_patch(2), PnTriangle(middle, middle_normal)};
    std::uint32_t vertex = pattern.face_vertex(f, 0);
    for (const InnerPoint& q : pattern.inner) {
      s.drawn_position.set(vertex++, patch[q.patch].point(q.local, bend_weights(q.local)));
    }
  }
}

}  // namespace

bool Tessellation::validate() const {
  const bool curved = mode != SurfaceMode::kFlat;
  return mode <= SurfaceMode::kArcPn && garment != nullptr && pattern != nullptr && position.x != nullptr &&
         (!curved || normal.x != nullptr) && (!has_folds(mode) || (fold.x != nullptr && fold_height != nullptr)) &&
         drawn_position.x != nullptr;
}

void Tessellation::run() const {
  const std::uint32_t particles = garment->particle_count;
  std::copy(position.x, position.x + particles, drawn_position.x);
  std::copy(position.y, position.y + particles, drawn_position.y);
  std::copy(position.z, position.z + particles, drawn_position.z);
  switch (mode) {
    case SurfaceMode::kFlat:
      return draw_flat(*this);
    case SurfaceMode::kPn:
      return run_wide(widest_vectors(), [this] { draw_curved<SurfaceMode::kPn>(*this); });
    case SurfaceMode::kPaper:
      return draw_paper(*this);
    case SurfaceMode::kPleat:
      return run_wide(widest_vectors(), [this] { draw_curved<SurfaceMode::kPleat>(*this); });
    case SurfaceMode::kPhong:
      return draw_lifted<phong_point>(*this);
    case SurfaceMode::kSpherigon:
      return draw_lifted<spherigon_point>(*this);
    case SurfaceMode::kArcPn:
      return draw_curved<SurfaceMode::kArcPn>(*this);
  }
}

}  // namespace pleat
