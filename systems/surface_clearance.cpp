#include "systems/surface_clearance.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "systems/capsule_lanes.h"

namespace pleat {
namespace {

/// Eight faces, and how their drawn vertices are moved from the footprints.
struct FaceGroup {
  Vec3Lanes corner[3], center;  // m, of the coarse triangle
  Lanes size, bulge;            // m, from the center to the furthest corner; the largest motion

  PLEAT_KERNEL FaceGroup(const SurfaceClearance& in, std::uint32_t begin, std::uint32_t count) : bulge{} {
    const std::uint32_t vertices = in.pattern->vertices_per_face;
    const std::uint32_t* drawn = in.pattern->face_vertices.data() + std::size_t{begin} * vertices;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      std::uint32_t index[kLanes];
      for (std::uint32_t k = 0; k < kLanes; ++k) index[k] = drawn[std::size_t{std::min(k, count - 1)} * vertices + v];
      if (v < 3) corner[v] = gather(in.footprint, index);
      bulge = max(gather(in.moved, index), bulge);
    }
    center = (corner[0] + corner[1] + corner[2]) * (1.0f / 3.0f);
    size = max(max(length(corner[0] - center), length(corner[1] - center)), length(corner[2] - center));
  }
};

/// The drawn vertices of one face in the face's own numbering, and what a capsule makes of them.
struct FaceVertices {
  static constexpr std::uint32_t kRoom = (kMaxVerticesPerFace + kLanes - 1) / kLanes * kLanes;
  const std::uint32_t* drawn;
  std::uint32_t room;                     // of vertices, in whole lanes, whose rest repeats the first vertex
  float longest_side2;                    // m2, of a footprint at most, squared
  float bulge;                            // m, of the vertices, the largest motion
  float x[kRoom], y[kRoom], z[kRoom];     // m, on the coarse triangle
  float dx[kRoom], dy[kRoom], dz[kRoom];  // m, from there to where they are drawn
  float moved[kRoom], distance2[kRoom], approach[kRoom];  // m, m2, m: the length of that; see measure

  PLEAT_KERNEL FaceVertices(const SurfaceClearance& in, std::uint32_t f, float largest_motion)
      : drawn(in.pattern->face_vertices.data() + std::size_t{f} * in.pattern->vertices_per_face),
        room((in.pattern->vertices_per_face + kLanes - 1) / kLanes * kLanes),
        bulge(largest_motion) {
    const std::uint32_t count = in.pattern->vertices_per_face;
    for (std::uint32_t i = 0; i < room; i += kLanes) {
      std::uint32_t index[kLanes];
      for (std::uint32_t k = 0; k < kLanes; ++k) index[k] = drawn[i + k < count ? i + k : 0];
      const Vec3Lanes place = gather(in.footprint, index);
      store(place, {x, y, z}, i);
      store(gather(in.drawn_position, index) - place, {dx, dy, dz}, i);
      store(gather(in.moved, index), moved + i);
    }
    const Vec3 a = at(0), b = at(1), c = at(2);
    // A footprint joins neighbours on the grid of the pattern; in the fan also the center to an edge's middle.
    const float share = in.pattern->level == 0 ? 1.0f / 3.0f : 1.0f / static_cast<float>(in.pattern->segments);
    longest_side2 = share * share * std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  }

  Vec3 at(std::uint32_t i) const { return {x[i], y[i], z[i]}; }

  /// How far the places are from the core, squared, m2, and how far the motion goes towards it, m. Returns the least of
  /// the first.
  PLEAT_KERNEL float measure(const CapsulePose& c) {
    const Core core(c, 0.0f);
    Lanes least = all(std::numeric_limits<float>::max());
    for (std::uint32_t i = 0; i < room; i += kLanes) {
      const Vec3Lanes away = away_from(core, load({x, y, z}, i));
      const Lanes d2 = dot(away, away);
      store(d2, distance2 + i);
      store(-dot(away, load({dx, dy, dz}, i)) / sqrt(d2), approach + i);
      least = min(d2, least);
    }
    return -largest(-least);
  }

  /// How far the vertices approach the core at most, m, where a footprint is `distance` or more from it: see stays_out.
  PLEAT_KERNEL float largest_fall(float distance) const {
    const float turn = std::sqrt(longest_side2) / distance;
    Lanes most{};
    for (std::uint32_t i = 0; i < room; i += kLanes) most = max(load(approach + i) + load(moved + i) * turn, most);
    return largest(most);
  }
};

struct Lifter {
  const SurfaceClearance& in;
  mutable bool has_settled = false;  // so that what is known of motions has to be looked up anew

  PLEAT_KERNEL void measure_motion() const {
    for (std::size_t v = 0; v < in.pattern->vertex_count; v += kLanes) {
      store(length(load(in.drawn_position, v) - load(in.footprint, v)), in.moved + v);
    }
  }

  PLEAT_KERNEL void gather_planes(std::uint32_t begin, std::uint32_t count) const {
    FaceGroup faces(in, begin, count);
    const auto for_each = [&](const LaneMask& near, const auto& visit) {
      has_settled = false;
      for (std::uint32_t rest = bits(near & first_lanes(count)); rest != 0; rest &= rest - 1) {
        const int k = std::countr_zero(rest);
        visit(begin + static_cast<std::uint32_t>(k), faces.bulge[k]);
      }
      if (has_settled) faces = FaceGroup(in, begin, count);
    };
    for (std::size_t k = 0; k < in.half_space_count; ++k) {
      if (!in.half_spaces[k].enabled) continue;
      const PlanePose body(in.half_spaces[k], in.t);
      const Lanes reach = body.height + in.clearance + faces.size + 2.0f * faces.bulge;
      for_each(dot(all(body.normal), faces.center) < reach,
               [&](std::uint32_t f, float bulge) { keep_above(f, bulge, body); });
    }
    for (std::uint32_t k = 0; k < in.capsule_count; ++k) {
      const CapsulePose& capsule = in.capsules[k];
      const float kept = widest_radius(capsule) + in.clearance;
      for_each(may_touch(faces, Core(capsule, 0.0f), kept), [&](std::uint32_t f, float bulge) {
        FaceVertices face(in, f, bulge);
        add_planes(face, capsule, kept, face.measure(capsule));
      });
    }
  }

  /// Not where the coarse triangle is further from the core than the largest motion of a vertex and what is kept.
  static PLEAT_KERNEL LaneMask may_touch(const FaceGroup& faces, const Core& core, float kept) {
    const Vec3Lanes away = away_from(core, faces.center);
    const Lanes around = kept + faces.size + faces.bulge, far = kept + faces.bulge + kLaneRounding;
    const LaneMask near = dot(away, away) < around * around;
    if (!any(near)) return near;
    return near & (TriangleGap(core, faces.corner[0], faces.corner[1], faces.corner[2]).distance2 < far * far);
  }

  /// A half-space is its own plane for every vertex, also for those that a capsule may still move by a bulge.
  void keep_above(std::uint32_t f, float bulge, const PlanePose& body) const {
    const float height = body.height + in.clearance;
    const std::uint32_t count = in.pattern->vertices_per_face;
    const std::uint32_t* drawn = in.pattern->face_vertices.data() + std::size_t{f} * count;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t v = drawn[i];
      if (dot(body.normal, in.drawn_position[v]) < height + bulge) add({body.normal, height, {v, v, v}});
    }
  }

  PLEAT_KERNEL void add_planes(const FaceVertices& face, const CapsulePose& capsule, float kept, float nearest2) const {
    const float far = kept + face.bulge, far2 = far * far + face.longest_side2 * (1.0f / 3.0f);
    if (nearest2 >= far2) return;
    const float distance2 = nearest2 - face.longest_side2 * (1.0f / 3.0f);
    if (distance2 > kept * kept && std::sqrt(distance2) >= kept + face.largest_fall(std::sqrt(distance2))) return;
    const std::uint32_t* t = in.pattern->face_triangles.data();
    const std::uint32_t* end = t + in.pattern->face_triangles.size();
    PlaneBatch batch;
    for (; t != end; t += 3) {
      const float near2 = std::min({face.distance2[t[0]], face.distance2[t[1]], face.distance2[t[2]]});
      if (near2 >= far2 || stays_out(face, t, near2, kept)) continue;
      for (std::size_t k = 0; k < 3; ++k) batch.corner[k][batch.count] = t[k];
      if (++batch.count == kLanes) flush(face, capsule, batch);
    }
    if (batch.count != 0) flush(face, capsule, batch);
  }

  /// Without the plane, from below. A footprint of longest side s whose corners are at least d from the core is
  /// D >= sqrt(d^2 - s^2/3) from it, for no point of it is further than s/sqrt(3) from all corners. Over the footprint
  /// the direction away from the core turns by at most s/D, so a vertex that moves by m and approaches the core by h,
  /// as seen from its own place, falls towards the core by at most h + m s/D.
  static bool stays_out(const FaceVertices& face, const std::uint32_t* t, float nearest2, float kept) {
    const Vec3 a = face.at(t[0]), b = face.at(t[1]), c = face.at(t[2]);
    const float side2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    const float distance2 = nearest2 - side2 * (1.0f / 3.0f);
    if (distance2 <= kept * kept) return false;
    const float distance = std::sqrt(distance2), turn = std::sqrt(side2) / distance;
    float fall = 0.0f;
    for (int k = 0; k < 3; ++k) fall = std::max(fall, face.approach[t[k]] + face.moved[t[k]] * turn);
    return distance >= kept + fall;
  }

  /// Footprints that need their planes, as corners in their face's numbering; places without one repeat others.
  struct PlaneBatch {
    std::uint32_t corner[3][kLanes] = {}, count = 0;
  };

  PLEAT_KERNEL void flush(const FaceVertices& face, const CapsulePose& capsule, PlaneBatch& batch) const {
    const ConstVec3View at{face.x, face.y, face.z};
    const Vec3Lanes a = gather(at, batch.corner[0]), b = gather(at, batch.corner[1]), c = gather(at, batch.corner[2]);
    const Vec3Lanes away =
        capsule.taper == 0.0f ? TriangleGap(Core(capsule, 0.0f), a, b, c).away : away_from_tapered(capsule, a, b, c);
    const Vec3Lanes normal = normalized_or(away, normalized_or(cross(b - a, c - a), all(Vec3{0, 1, 0})));
    const Lanes height =
        max(dot(normal, all(capsule.a)), dot(normal, all(capsule.b)) + capsule.taper) + (capsule.radius + in.clearance);
    for (std::uint32_t k = 0; k < batch.count; ++k) {
      add({{normal.x[k], normal.y[k], normal.z[k]},
           height[k],
           {face.drawn[batch.corner[0][k]], face.drawn[batch.corner[1][k]], face.drawn[batch.corner[2][k]]}});
    }
    batch.count = 0;
  }

  static Vec3Lanes away_from_tapered(const CapsulePose& capsule, const Vec3Lanes& a, const Vec3Lanes& b,
                                     const Vec3Lanes& c) {
    Vec3Lanes all_away;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const auto lane = [k](const Vec3Lanes& v) { return Vec3{v.x[k], v.y[k], v.z[k]}; };
      const Vec3 away = gap_to_triangle(capsule, lane(a), lane(b), lane(c)).away;
      all_away.x[k] = away.x, all_away.y[k] = away.y, all_away.z[k] = away.z;
    }
    return all_away;
  }

  void add(const ClearancePlane& plane) const {
    if (in.planes.is_full()) {
      in.planes.settle(in.drawn_position);
      measure_motion();
      has_settled = true;
    }
    in.planes.add(plane, in.drawn_position);
  }
};

}  // namespace

bool SurfaceClearance::validate() const {
  return garment != nullptr && pattern != nullptr && footprint.x != nullptr &&
         (capsules != nullptr || capsule_count == 0) && (half_spaces != nullptr || half_space_count == 0) &&
         clearance >= 0.0f && moved != nullptr && planes.validate() && drawn_position.x != nullptr;
}

void SurfaceClearance::run() const {
  if (capsule_count + half_space_count != 0) {
    const Lifter lifter{*this};
    run_wide(widest_vectors(), [&] {
      lifter.measure_motion();
      for (std::uint32_t f = 0; f < garment->face_count; f += kLanes) {
        lifter.gather_planes(f, std::min(kLanes, garment->face_count - f));
      }
    });
  }
  planes.settle(drawn_position);
}

}  // namespace pleat
