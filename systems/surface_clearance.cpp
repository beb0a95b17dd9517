#include "systems/surface_clearance.h"

#include <algorithm>
#include <limits>

#include "systems/capsule_lanes.h"

namespace pleat {
namespace {

/// The drawn vertices of one face in the face's own numbering, and what a capsule makes of them.
struct FaceVertices {
  static constexpr std::uint32_t kRoom = (kMaxVerticesPerFace + kLanes - 1) / kLanes * kLanes;
  const std::uint32_t* drawn;
  std::uint32_t count, room;              // of vertices; in whole lanes, whose rest repeats the first vertex
  Vec3 corner[3];                         // m, of the coarse triangle
  float longest_side2;                    // m2, of a footprint at most, squared
  Vec3 center;                            // m, of the face
  float size, bulge;                      // m, from the center to the furthest corner; of the vertices, the largest
  float x[kRoom], y[kRoom], z[kRoom];     // m, on the coarse triangle
  float dx[kRoom], dy[kRoom], dz[kRoom];  // m, from there to where they are drawn
  float moved[kRoom], distance2[kRoom], approach[kRoom];  // m, m2, m: the length of that; see measure

  PLEAT_KERNEL FaceVertices(const SurfaceClearance& in, std::uint32_t f)
      : drawn(in.pattern->face_vertices.data() + std::size_t{f} * in.pattern->vertices_per_face),
        count(in.pattern->vertices_per_face),
        room((count + kLanes - 1) / kLanes * kLanes) {
    Lanes most{};
    for (std::uint32_t i = 0; i < room; i += kLanes) {
      std::uint32_t index[kLanes];
      for (std::uint32_t k = 0; k < kLanes; ++k) index[k] = drawn[i + k < count ? i + k : 0];
      const Vec3Lanes place = gather(in.footprint, index), motion = gather(in.drawn_position, index) - place;
      const Lanes motion_length = length(motion);
      store(place, {x, y, z}, i);
      store(motion, {dx, dy, dz}, i);
      store(motion_length, moved + i);
      most = max(motion_length, most);
    }
    bulge = largest(most);
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = in.footprint[drawn[k]];
    const auto [a, b, c] = corner;
    center = (a + b + c) * (1.0f / 3.0f);
    size = std::max({length(a - center), length(b - center), length(c - center)});
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

  PLEAT_KERNEL void gather_planes(std::uint32_t f) const {
    FaceVertices face(in, f);
    for (std::size_t k = 0; k < in.half_space_count; ++k) {
      if (in.half_spaces[k].enabled) keep_above(face, {in.half_spaces[k], in.t});
    }
    for (std::uint32_t k = 0; k < in.capsule_count; ++k) {
      const CapsulePose& capsule = in.capsules[k];
      const float kept = widest_radius(capsule) + in.clearance, near = kept + face.size + face.bulge;
      const Vec3 away = face.center - lerp(capsule.a, capsule.b, closest_on_segment(face.center, capsule.a, capsule.b));
      if (dot(away, away) >= near * near) continue;
      add_planes(face, capsule, kept, face.measure(capsule));
    }
  }

  /// A half-space is its own plane for every vertex, also for those that a capsule may still move by a bulge.
  void keep_above(const FaceVertices& face, const PlanePose& body) const {
    const float height = body.height + in.clearance;
    if (dot(body.normal, face.center) >= height + face.size + 2.0f * face.bulge) return;
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t v = face.drawn[i];
      if (dot(body.normal, in.drawn_position[v]) < height + face.bulge) add({body.normal, height, {v, v, v}});
    }
  }

  PLEAT_KERNEL void add_planes(const FaceVertices& face, const CapsulePose& capsule, float kept, float nearest2) const {
    const float far = kept + face.bulge, far2 = far * far + face.longest_side2 * (1.0f / 3.0f);
    if (nearest2 >= far2) return;
    const float distance2 = nearest2 - face.longest_side2 * (1.0f / 3.0f);
    if (distance2 > kept * kept && std::sqrt(distance2) >= kept + face.largest_fall(std::sqrt(distance2))) return;
    const std::uint32_t* t = in.pattern->face_triangles.data();
    const std::uint32_t* end = t + in.pattern->face_triangles.size();
    for (; t != end; t += 3) {
      const float near2 = std::min({face.distance2[t[0]], face.distance2[t[1]], face.distance2[t[2]]});
      if (near2 < far2 && !stays_out(face, t, near2, kept)) add_plane(face, t, capsule);
    }
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

  void add_plane(const FaceVertices& face, const std::uint32_t* t, const CapsulePose& capsule) const {
    const Vec3 a = face.at(t[0]), b = face.at(t[1]), c = face.at(t[2]);
    const Vec3 away = gap_to_triangle(capsule, a, b, c).away;
    const float distance = length(away);
    const Vec3 normal = distance > 1e-9f ? away * (1.0f / distance) : normalized_or(cross(b - a, c - a), Vec3{0, 1, 0});
    const float height = std::max(dot(normal, capsule.a), dot(normal, capsule.b) + capsule.taper) + capsule.radius;
    add({normal, height + in.clearance, {face.drawn[t[0]], face.drawn[t[1]], face.drawn[t[2]]}});
  }

  void add(const ClearancePlane& plane) const { in.planes.add(plane, in.drawn_position); }
};

}  // namespace

bool SurfaceClearance::validate() const {
  return garment != nullptr && pattern != nullptr && footprint.x != nullptr &&
         (capsules != nullptr || capsule_count == 0) && (half_spaces != nullptr || half_space_count == 0) &&
         clearance >= 0.0f && planes.validate() && drawn_position.x != nullptr;
}

void SurfaceClearance::run() const {
  if (capsule_count + half_space_count != 0) {
    const Lifter lifter{*this};
    run_wide(widest_vectors(), [&] {
      for (std::uint32_t f = 0; f < garment->face_count; ++f) lifter.gather_planes(f);
    });
  }
  planes.settle(drawn_position);
}

}  // namespace pleat
