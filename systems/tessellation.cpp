#include "systems/tessellation.h"

#include <algorithm>

#include "components/arc_pn.h"
#include "components/lane_rows.h"
#include "components/projected_triangle.h"
#include "components/wide.h"

namespace pleat {
namespace {

static_assert((2 * kMaxTessellationLevel - 1) * (2 * kMaxTessellationLevel - 2) / 2 <= LaneRows::kMostPlaces,
              "a face's inner vertices are a row");

std::uint32_t inner_count(const TessellationPattern& pattern) {
  return static_cast<std::uint32_t>(pattern.inner.size());
}

PLEAT_KERNEL void draw_flat(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  LaneRows rows;
  for (std::uint32_t e = 0; e < g.edge_count; e += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - e);
    const Vec3Lanes a = gather(s.position, g.edge_particle[0].data() + e),
                    d = gather(s.position, g.edge_particle[1].data() + e) - a;
    for (std::uint32_t i = 0; i < pattern.segments - 1; ++i) {
      rows.set(i, a + d * pattern.along_edge(i + 1));
    }
    rows.store_to(s.drawn_position, pattern.edge_vertex(e, 1), pattern.segments - 1, count);
  }
  for (std::uint32_t f = 0; f < g.face_count; f += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - f);
    const auto position = [&](std::size_t k) { return gather(s.position, g.face_particle[k].data() + f); };
    const Vec3Lanes corner[3] = {position(0), position(1), position(2)};
    for (std::uint32_t i = 0; i < inner_count(pattern); ++i) {
      const InnerPoint& q = pattern.inner[i];
      rows.set(i, corner[0] * q.face[0] + corner[1] * q.face[1] + corner[2] * q.face[2]);
    }
    rows.store_to(s.drawn_position, pattern.face_vertex(f, 0), inner_count(pattern), count);
  }
}

PnEdge pn_edge(const Tessellation& s, std::uint32_t e) {
  const std::uint32_t i = s.garment->edge_particle[0][e], j = s.garment->edge_particle[1][e];
  return {s.position[i], s.position[j], s.normal[i], s.normal[j]};
}

template <SurfaceMode mode, class T>
PnEdgeT<T> curved_edge(const Vec3T<T>& a, const Vec3T<T>& b, const Vec3T<T>& na, const Vec3T<T>& nb) {
  return mode == SurfaceMode::kArcPn ? arc_edge(a, b, na, nb) : PnEdgeT<T>(a, b, na, nb);
}

/// kPn, kArcPn, and with folds kPleat: the vertices on edges.
template <SurfaceMode mode>
PLEAT_KERNEL void draw_curved_edges(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  LaneRows rows;
  for (std::uint32_t e = 0; e < g.edge_count; e += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - e);
    PnEdgeT<Lanes> edge;
    if (mode == SurfaceMode::kPleat && s.curves != nullptr) {
      edge = s.curves[e / kLanes].curve;
    } else {
      const EdgeBlock block(g, s.position, s.normal, e);
      edge = curved_edge<mode>(block.a, block.b, block.na, block.nb);
    }
    Vec3Lanes moved{};
    if constexpr (mode == SurfaceMode::kPleat) moved = load(s.fold, e) * load(s.fold_height + e);
    for (std::uint32_t i = 0; i < pattern.segments - 1; ++i) {
      const float t = pattern.along_edge(i + 1);
      rows.set(i, edge.point(t) + moved * fold_shape(t));
    }
    rows.store_to(s.drawn_position, pattern.edge_vertex(e, 1), pattern.segments - 1, count);
  }
}

/// The sides of face f that are creases bend as the edges do, not as the face's own normals say.
template <SurfaceMode mode>
void bend_along_creases(const Tessellation& s, std::uint32_t f, std::uint32_t lane, Vec3Lanes (&bend)[6]) {
  const Garment& g = *s.garment;
  const auto set = [&](Vec3Lanes& lanes, const Vec3& v) {
    lanes.x[lane] = v.x, lanes.y[lane] = v.y, lanes.z[lane] = v.z;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t e = g.face_edge[k][f];
    if (!g.edge_is_crease[e]) continue;
    const std::size_t first = g.edge_particle[0][e] == g.face_particle[k][f] ? 0 : 1, last = 1 - first;
    const PnEdge side = curved_edge<mode>(s.position[g.edge_particle[first][e]], s.position[g.edge_particle[last][e]],
                                          s.normal[g.edge_normal[first][e]], s.normal[g.edge_normal[last][e]]);
    set(bend[2 * k], side.u), set(bend[2 * k + 1], side.v);
  }
}

/// The squares of how far the vertices along the sides of faces are from there, at most, m2. moved: by the folds.
PLEAT_KERNEL Lanes sides_bulge(const TessellationPattern& pattern, const PnTriangleT<Lanes>& face,
                               const Vec3Lanes (&moved)[3]) {
  Lanes bulge2{};
  for (std::uint32_t i = 0; i < pattern.segments - 1; ++i) {
    const float t = pattern.along_edge(i + 1), u = t * (1.0f - t) * (1.0f - t), v = t * t * (1.0f - t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3Lanes motion = moved[k] * fold_shape(t) - (face.bend[2 * k] * u + face.bend[2 * k + 1] * v);
      bulge2 = max(dot(motion, motion), bulge2);
    }
  }
  return bulge2;
}

/// kPn, kArcPn, and with folds kPleat: the vertices inside faces.
template <SurfaceMode mode>
PLEAT_KERNEL void draw_curved_faces(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  LaneRows rows;
  for (std::uint32_t f = 0; f < g.face_count; f += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - f);
    const auto position = [&](std::size_t k) { return gather(s.position, g.face_particle[k].data() + f); };
    const auto normal_at = [&](std::size_t k) { return gather(s.normal, g.face_normal[k].data() + f); };
    const auto height_of = [&](std::size_t k) {
      return mode == SurfaceMode::kPleat ? gather(s.fold_height, g.face_edge[k].data() + f) : Lanes{};
    };
    const auto fold = [&](std::size_t k, const Lanes& h) {
      return mode == SurfaceMode::kPleat ? gather(s.fold, g.face_edge[k].data() + f) * h : Vec3Lanes{};
    };
    const Vec3Lanes corner[3] = {position(0), position(1), position(2)};
    const Vec3Lanes normal[3] = {normal_at(0), normal_at(1), normal_at(2)};
    const Lanes height[3] = {height_of(0), height_of(1), height_of(2)};
    const Vec3Lanes moved[3] = {fold(0, height[0]), fold(1, height[1]), fold(2, height[2])};
    const LaneMask folds = (height[0] != 0.0f) | (height[1] != 0.0f) | (height[2] != 0.0f);
    PnTriangleT<Lanes> face =
        mode == SurfaceMode::kArcPn ? arc_triangle(corner, normal) : PnTriangleT<Lanes>(corner, normal);
    if (g.crease_count != 0) {
      for (std::uint32_t lane = 0; lane < count; ++lane) bend_along_creases<mode>(s, f + lane, lane, face.bend);
    }
    const bool any_fold = any(folds);
    Lanes bulge2 = s.bulge != nullptr ? sides_bulge(pattern, face, moved) : Lanes{};
    for (std::uint32_t i = 0; i < inner_count(pattern); ++i) {
      const InnerPoint& q = pattern.inner[i];
      Vec3Lanes x = face.point(q.face, q.bend);
      if (any_fold) x += moved[0] * q.fold[0] + moved[1] * q.fold[1] + moved[2] * q.fold[2];
      rows.set(i, x);
      const Vec3Lanes motion = x - face.flat(q.face);
      bulge2 = max(dot(motion, motion), bulge2);
    }
    if (s.bulge != nullptr) store(sqrt(bulge2), s.bulge + f);
    rows.store_to(s.drawn_position, pattern.face_vertex(f, 0), inner_count(pattern), count);
  }
}

template <SurfaceMode mode>
void draw_curved(const Tessellation& s) {
  run_wide(widest_vectors(), [&] {
    draw_curved_edges<mode>(s);
    draw_curved_faces<mode>(s);
  });
}

using LiftedPoint = Vec3Lanes (*)(const Vec3Lanes (&)[3], const Vec3Lanes (&)[3], const float (&)[3]);

/// kPhong, kSpherigon.
template <LiftedPoint point>
PLEAT_KERNEL void lift(const Tessellation& s) {
  const Garment& g = *s.garment;
  const TessellationPattern& pattern = *s.pattern;
  LaneRows rows;
  Vec3Lanes p[3], n[3];
  const auto gather_corner = [&](std::size_t corner, const std::uint32_t* index) {
    p[corner] = gather(s.position, index), n[corner] = gather(s.normal, index);
  };
  for (std::uint32_t e = 0; e < g.edge_count; e += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.edge_count - e);
    for (std::size_t k = 0; k < 3; ++k) gather_corner(k, g.edge_particle[k % 2].data() + e);  // the third has weight 0
    for (std::uint32_t i = 0; i < pattern.segments - 1; ++i) {
      const float t = pattern.along_edge(i + 1);
      rows.set(i, point(p, n, {1.0f - t, t, 0.0f}));
    }
    rows.store_to(s.drawn_position, pattern.edge_vertex(e, 1), pattern.segments - 1, count);
  }
  for (std::uint32_t f = 0; f < g.face_count; f += kLanes) {
    const std::uint32_t count = std::min(kLanes, g.face_count - f);
    for (std::size_t k = 0; k < 3; ++k) gather_corner(k, g.face_particle[k].data() + f);
    for (std::uint32_t i = 0; i < inner_count(pattern); ++i) {
      rows.set(i, point(p, n, pattern.inner[i].face));
    }
    rows.store_to(s.drawn_position, pattern.face_vertex(f, 0), inner_count(pattern), count);
  }
}

template <LiftedPoint point>
void draw_lifted(const Tessellation& s) {
  run_wide(widest_vectors(), [&] { lift<point>(s); });
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

bool Tessellation::tells_bulge(SurfaceMode mode) {
  return mode == SurfaceMode::kPn || mode == SurfaceMode::kPleat || mode == SurfaceMode::kArcPn;
}

bool Tessellation::validate() const {
  const bool curved = mode != SurfaceMode::kFlat;
  return mode <= SurfaceMode::kArcPn && garment != nullptr && pattern != nullptr && position.x != nullptr &&
         (!curved || normal.x != nullptr) && (!has_folds(mode) || (fold.x != nullptr && fold_height != nullptr)) &&
         drawn_position.x != nullptr && (bulge == nullptr || tells_bulge(mode));
}

void Tessellation::run() const {
  copy(drawn_position, position, garment->particle_count);
  switch (mode) {
    case SurfaceMode::kFlat:
      return run_wide(widest_vectors(), [this] { draw_flat(*this); });
    case SurfaceMode::kPn:
      return draw_curved<SurfaceMode::kPn>(*this);
    case SurfaceMode::kPaper:
      return draw_paper(*this);
    case SurfaceMode::kPleat:
      return draw_curved<SurfaceMode::kPleat>(*this);
    case SurfaceMode::kPhong:
      return draw_lifted<phong_point<Lanes>>(*this);
    case SurfaceMode::kSpherigon:
      return draw_lifted<spherigon_point<Lanes>>(*this);
    case SurfaceMode::kArcPn:
      return draw_curved<SurfaceMode::kArcPn>(*this);
  }
}

}  // namespace pleat
