#include "systems/surface_clearance.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "systems/capsule_lanes.h"

namespace pleat {
namespace {

/// Of a drawn vertex, on the flat triangles.
PLEAT_KERNEL Vec3Lanes place_on(const Vec3Lanes (&corner)[3], const std::array<float, 3>& weight) {
  return corner[0] * weight[0] + corner[1] * weight[1] + corner[2] * weight[2];
}

/// Eight faces, and how their drawn vertices are moved from the footprints.
struct FaceGroup {
  Vec3Lanes corner[3], center, area;  // m, of the coarse triangle; twice its area along its normal, m2
  Lanes size, bulge;                  // m, from the center to the furthest corner; the largest motion

  /// known: the vertices are where in.bulge tells.
  PLEAT_KERNEL FaceGroup(const SurfaceClearance& in, std::uint32_t begin, bool known) {
    const std::uint32_t* drawn = in.pattern->drawn_of_faces(begin);
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = gather(in.position, drawn + k * kLanes);
    bulge = known ? load(in.bulge + begin) : measured(in, drawn);
    center = (corner[0] + corner[1] + corner[2]) * (1.0f / 3.0f);
    size = max(max(length(corner[0] - center), length(corner[1] - center)), length(corner[2] - center));
    area = cross(corner[1] - corner[0], corner[2] - corner[0]);
  }

  PLEAT_KERNEL Lanes measured(const SurfaceClearance& in, const std::uint32_t* drawn) const {
    Lanes bulge2{};
    for (std::uint32_t v = 0; v < in.pattern->vertices_per_face; ++v) {
      const Vec3Lanes motion =
          gather(in.drawn_position, drawn + v * kLanes) - place_on(corner, in.pattern->face_weights[v]);
      bulge2 = max(dot(motion, motion), bulge2);
    }
    return sqrt(bulge2);
  }

  /// Not where the coarse triangle is further from the core than the largest motion of a vertex and what is kept, as
  /// either of two directions shows: that from the core's point nearest to the center, which has all of the core
  /// behind it, and the triangle's normal.
  PLEAT_KERNEL LaneMask may_touch(const Core& core) const {
    const float kept = core.reach;
    const Vec3Lanes away = away_from(core, center);
    const Lanes around = kept + size + bulge, distance2 = dot(away, away);
    const LaneMask near = distance2 < around * around;
    if (!any(near)) return near;
    const Lanes far = kept + bulge + kLaneRounding, far2 = far * far;
    const Vec3Lanes on_core = center - away;
    const Lanes beyond =
        min(min(dot(corner[0] - on_core, away), dot(corner[1] - on_core, away)), dot(corner[2] - on_core, away));
    const Lanes a = dot(core.a - center, area), b = dot(core.b - center, area);
    const LaneMask apart = (beyond > 0.0f) & (beyond * beyond >= far2 * distance2);
    const LaneMask aside = (a * b > 0.0f) & (min(a * a, b * b) >= far2 * dot(area, area));
    return near & ~(apart | aside);
  }
};

/// Not to be zeroed before they are made.
union Cores {
  Core each[kLanes];
  Cores() {}
};

constexpr std::size_t kMostTriangles = 4 * kMaxTessellationLevel * kMaxTessellationLevel;  // of a face

/// The square of a triangle's longest side, m2.
PLEAT_KERNEL Lanes longest_side_squared(const Vec3Lanes& a, const Vec3Lanes& b, const Vec3Lanes& c) {
  return max(max(dot(b - a, b - a), dot(c - b, c - b)), dot(a - c, a - c));
}

/// Of each lane's capsule.
struct CapsuleLanes {
  Core core;
  Lanes radius, taper, kept;  // m, of the ball about a; what the one about b has more; from the core by the footprints

  PLEAT_KERNEL CapsuleLanes(const SurfaceClearance& in, const std::uint32_t (&index)[kLanes])
      : core(in.capsules[index[0]], 0.0f) {
    const auto of_each = [&](const auto& value) {
      const CapsulePose* c = in.capsules;
      return Lanes{value(c[index[0]]), value(c[index[1]]), value(c[index[2]]), value(c[index[3]]),
                   value(c[index[4]]), value(c[index[5]]), value(c[index[6]]), value(c[index[7]])};
    };
    core.a.x = of_each([](const CapsulePose& c) { return c.a.x; });
    core.a.y = of_each([](const CapsulePose& c) { return c.a.y; });
    core.a.z = of_each([](const CapsulePose& c) { return c.a.z; });
    core.b.x = of_each([](const CapsulePose& c) { return c.b.x; });
    core.b.y = of_each([](const CapsulePose& c) { return c.b.y; });
    core.b.z = of_each([](const CapsulePose& c) { return c.b.z; });
    core.axis = core.b - core.a, core.axis2 = dot(core.axis, core.axis);
    const LaneMask long_enough = core.axis2 > 0.0f;
    core.inverse = long_enough ? 1.0f / (long_enough ? core.axis2 : all(1.0f)) : Lanes{};
    radius = of_each([](const CapsulePose& c) { return c.radius; });
    taper = of_each([](const CapsulePose& c) { return c.taper; });
    kept = radius + max(taper, Lanes{}) + in.clearance;
  }
};

/// Faces that may need planes against a capsule, a pair of the two in each lane.
struct Pairs {
  std::uint32_t face[kLanes], capsule[kLanes], count = 0;

  PLEAT_KERNEL void add(std::uint32_t f, std::uint32_t k) { face[count] = f, capsule[count] = k, ++count; }
  PLEAT_KERNEL void fill() {
    for (std::uint32_t k = count; k < kLanes; ++k) face[k] = face[0], capsule[k] = capsule[0];
  }
};

/// The drawn vertices of the faces of pairs, in the faces' own numbering, and what the capsules make of them.
struct PairVertices {
  static constexpr std::size_t kRoom = kMaxVerticesPerFace * kLanes;
  float x[kRoom], y[kRoom], z[kRoom];                     // m, on the coarse triangle
  float moved[kRoom], distance2[kRoom], approach[kRoom];  // m, from there to where they are drawn; m2, from the core;
                                                          // m, how far the motion goes towards it
  Lanes longest_side2, bulge;                             // m2, of a footprint at most, squared; m, the largest motion

  PLEAT_KERNEL PairVertices(const SurfaceClearance& in, const Pairs& pairs, const Core& core) : bulge{} {
    const std::uint32_t vertices = in.pattern->vertices_per_face;
    const std::uint32_t* row[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) {
      row[k] = in.pattern->face_vertices.data() + std::size_t{pairs.face[k]} * vertices;
    }
    const auto of_each = [&](ConstVec3View column, std::uint32_t v) {
      const std::uint32_t index[kLanes] = {row[0][v], row[1][v], row[2][v], row[3][v],
                                           row[4][v], row[5][v], row[6][v], row[7][v]};
      return gather(column, index);
    };
    const Vec3Lanes corner[3] = {of_each(in.position, 0), of_each(in.position, 1), of_each(in.position, 2)};
    for (std::uint32_t v = 0; v < vertices; ++v) {
      const Vec3Lanes place = place_on(corner, in.pattern->face_weights[v]);
      const Vec3Lanes motion = of_each(in.drawn_position, v) - place;
      const Lanes by = length(motion);
      const Vec3Lanes away = away_from(core, place);
      const Lanes d2 = dot(away, away);
      store(place, {x, y, z}, v * kLanes), store(by, moved + v * kLanes), store(d2, distance2 + v * kLanes);
      store(-dot(away, motion) / sqrt(d2), approach + v * kLanes);
      bulge = max(by, bulge);
    }
    // A footprint joins neighbours on the grid of the pattern; in the fan also the center to an edge's middle.
    const float share = in.pattern->level == 0 ? 1.0f / 3.0f : 1.0f / static_cast<float>(in.pattern->segments);
    longest_side2 = share * share * longest_side_squared(corner[0], corner[1], corner[2]);
  }

  PLEAT_KERNEL Vec3Lanes at(std::uint32_t v) const { return load({x, y, z}, v * kLanes); }

  /// Where footprint t needs its plane, from below. A footprint of longest side s whose corners are at least d from the
  /// core is D >= sqrt(d^2 - s^2/3) from it, for no point of it is further than s/sqrt(3) from all corners. Over the
  /// footprint the direction away from the core turns by at most s/D, so a vertex that moves by m and approaches the
  /// core by h, as seen from its own place, falls towards the core by at most h + m s/D.
  PLEAT_KERNEL LaneMask may_fall_behind(const std::uint32_t* t, const Lanes& kept) const {
    const auto of = [&](const float* column, std::size_t k) { return load(column + t[k] * kLanes); };
    const Lanes near2 = min(min(of(distance2, 0), of(distance2, 1)), of(distance2, 2));
    const Lanes far = kept + bulge;
    const LaneMask near = near2 < far * far + longest_side2 * (1.0f / 3.0f);
    if (!any(near)) return near;
    const Lanes side2 = longest_side_squared(at(t[0]), at(t[1]), at(t[2]));
    const Lanes apart2 = near2 - side2 * (1.0f / 3.0f);
    const LaneMask apart = apart2 > kept * kept;
    const Lanes distance = sqrt(apart ? apart2 : all(1.0f)), turn = sqrt(side2) / distance;
    Lanes fall{};
    for (std::size_t k = 0; k < 3; ++k) fall = max(of(approach, k) + of(moved, k) * turn, fall);
    return near & ~(apart & (distance >= kept + fall));
  }
};

/// Footprints that need their planes, one a lane: corners, m, on the coarse triangle, and which drawn vertices they
/// are. Lanes without one repeat the first.
struct PlaneGroup {
  float x[3][kLanes], y[3][kLanes], z[3][kLanes];
  std::uint32_t vertex[3][kLanes], capsule[kLanes], count = 0;

  PLEAT_KERNEL void fill() {
    for (std::uint32_t k = count; k < kLanes; ++k) {
      capsule[k] = capsule[0];
      for (std::size_t c = 0; c < 3; ++c) x[c][k] = x[c][0], y[c][k] = y[c][0], z[c][k] = z[c][0];
    }
  }
};

struct Lifter {
  const SurfaceClearance& in;
  Pairs pairs;
  PlaneGroup planes;
  explicit Lifter(const SurfaceClearance& system) : in(system) {}
  std::uint32_t settled = 0;  // how often: then what is known of motions has to be looked up anew

  // Kernels of their own: one copy of each, wherever they are called from.
  void keep_apart() {
    run_wide(widest_vectors(), [this] { find_footprints(); });
  }
  void add_planes() {
    run_wide(widest_vectors(), [this] { find_planes(); });
  }

  PLEAT_KERNEL void run() {
    for (std::size_t k = 0; k < in.half_space_count; ++k) {
      if (in.half_spaces[k].meets(in.collides_with)) look_at(PlanePose(in.half_spaces[k], in.t, in.origin));
    }
    for (std::uint32_t k = 0; k < in.capsule_count; k += kLanes) look_at(k, std::min(kLanes, in.capsule_count - k));
    if (pairs.count != 0) keep_apart();
    if (planes.count != 0) add_planes();
  }

  /// Of eight faces, as their vertices are now; a bit for each that there is.
  PLEAT_KERNEL FaceGroup group(std::uint32_t begin) const {
    return FaceGroup(in, begin, in.bulge != nullptr && settled == 0);
  }
  PLEAT_KERNEL std::uint32_t valid(std::uint32_t begin) const {
    return bits(first_lanes(in.garment->face_count - begin));
  }

  PLEAT_KERNEL void look_at(const PlanePose& body) {
    for (std::uint32_t begin = 0; begin < in.garment->face_count; begin += kLanes) {
      FaceGroup faces = group(begin);
      const Lanes reach = body.height + in.clearance + faces.size + 2.0f * faces.bulge;
      std::uint32_t near = bits(dot(all(body.normal), faces.center) < reach) & valid(begin);
      for (; near != 0; near &= near - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(near));
        const std::uint32_t before = settled;
        keep_above(begin + lane, faces.bulge[lane], body);
        if (settled != before) faces = group(begin);
      }
    }
  }

  /// Capsules from `first` on, at most as many as there are lanes.
  PLEAT_KERNEL void look_at(std::uint32_t first, std::uint32_t count) {
    Cores cores;
    for (std::uint32_t k = 0; k < count; ++k) {
      const CapsulePose& capsule = in.capsules[first + k];
      std::construct_at(cores.each + k, capsule, widest_radius(capsule) + in.clearance);
    }
    for (std::uint32_t begin = 0; begin < in.garment->face_count; begin += kLanes) {
      FaceGroup faces = group(begin);
      for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t before = settled;
        std::uint32_t near = bits(faces.may_touch(cores.each[k])) & valid(begin);
        for (; near != 0; near &= near - 1) {
          pairs.add(begin + static_cast<std::uint32_t>(std::countr_zero(near)), first + k);
          if (pairs.count == kLanes) keep_apart();
        }
        if (settled != before) faces = group(begin);
      }
    }
  }

  /// A half-space is its own plane for every vertex, also for those that a capsule may still move by a bulge.
  void keep_above(std::uint32_t f, float bulge, const PlanePose& body) {
    const float height = body.height + in.clearance;
    const std::uint32_t count = in.pattern->vertices_per_face;
    const std::uint32_t* drawn = in.pattern->face_vertices.data() + std::size_t{f} * count;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t v = drawn[i];
      if (dot(body.normal, in.drawn_position[v]) < height + bulge) add({body.normal, height, {v, v, v}});
    }
  }

  /// Looks for footprints that need planes, one pair after the other; then there are no pairs. Vertices that planes
  /// move on the way, where the list is full, are looked at anew.
  PLEAT_KERNEL void find_footprints() {
    pairs.fill();
    const CapsuleLanes capsules(in, pairs.capsule);
    const std::uint32_t* triangles = in.pattern->face_triangles.data();
    const std::uint32_t end = static_cast<std::uint32_t>(in.pattern->face_triangles.size());
    for (std::uint32_t lane = 0; lane < pairs.count;) {
      const PairVertices vertices(in, pairs, capsules.core);
      std::uint16_t of_lane[kLanes][kMostTriangles];  // of face_triangles, where footprints begin
      std::uint32_t count[kLanes]{};
      for (std::uint32_t t = 0; t < end; t += 3) {
        std::uint32_t rest = bits(vertices.may_fall_behind(triangles + t, capsules.kept));
        for (; rest != 0; rest &= rest - 1) {
          const int k = std::countr_zero(rest);
          of_lane[k][count[k]++] = static_cast<std::uint16_t>(t);
        }
      }
      const std::uint32_t before = settled;
      for (; lane < pairs.count && settled == before; ++lane) {
        const std::uint32_t* drawn =
            in.pattern->face_vertices.data() + std::size_t{pairs.face[lane]} * in.pattern->vertices_per_face;
        for (std::uint32_t i = 0; i < count[lane]; ++i) {
          const std::uint32_t* corner = triangles + of_lane[lane][i];
          const std::uint32_t n = planes.count++;
          planes.capsule[n] = pairs.capsule[lane];
          for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t v = corner[c] * kLanes + lane;
            planes.x[c][n] = vertices.x[v], planes.y[c][n] = vertices.y[v], planes.z[c][n] = vertices.z[v];
            planes.vertex[c][n] = drawn[corner[c]];
          }
          if (planes.count == kLanes) add_planes();
        }
      }
    }
    pairs.count = 0;
  }

  PLEAT_KERNEL void find_planes() {
    planes.fill();
    const CapsuleLanes capsules(in, planes.capsule);
    const auto corner = [&](std::size_t c) { return load({planes.x[c], planes.y[c], planes.z[c]}, 0); };
    const Vec3Lanes a = corner(0), b = corner(1), c = corner(2);
    Vec3Lanes away = TriangleGap(capsules.core, a, b, c).away;
    if (any(capsules.taper != 0.0f)) set_tapered(a, b, c, away);
    const Vec3Lanes normal = normalized_or(away, normalized_or(cross(b - a, c - a), all(Vec3{0, 1, 0})));
    const Lanes height = max(dot(normal, capsules.core.a), dot(normal, capsules.core.b) + capsules.taper) +
                         (capsules.radius + in.clearance);
    Vec4 side[kLanes];
    pack(normal, height, side);
    for (std::uint32_t k = 0; k < planes.count; ++k) {
      add({{side[k].x, side[k].y, side[k].z},
           side[k].w,
           {planes.vertex[0][k], planes.vertex[1][k], planes.vertex[2][k]}});
    }
    planes.count = 0;
  }

  void set_tapered(const Vec3Lanes& a, const Vec3Lanes& b, const Vec3Lanes& c, Vec3Lanes& away) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const CapsulePose& capsule = in.capsules[planes.capsule[k]];
      if (capsule.taper == 0.0f) continue;
      const auto lane = [k](const Vec3Lanes& v) { return Vec3{v.x[k], v.y[k], v.z[k]}; };
      const Vec3 found = gap_to_triangle(capsule, lane(a), lane(b), lane(c)).away;
      away.x[k] = found.x, away.y[k] = found.y, away.z[k] = found.z;
    }
  }

  void add(const ClearancePlane& plane) {
    if (in.planes.is_full()) {
      in.planes.settle(in.drawn_position);
      ++settled;
    }
    in.planes.add(plane, in.drawn_position);
  }
};

}  // namespace

bool SurfaceClearance::validate() const {
  return garment != nullptr && pattern != nullptr && position.x != nullptr &&
         (capsules != nullptr || capsule_count == 0) && (half_spaces != nullptr || half_space_count == 0) &&
         clearance >= 0.0f && planes.validate() && drawn_position.x != nullptr;
}

void SurfaceClearance::run() const {
  if (capsule_count + half_space_count != 0) {
    Lifter lifter(*this);
    run_wide(widest_vectors(), [&] { lifter.run(); });
  }
  planes.settle(drawn_position);
}

}  // namespace pleat
