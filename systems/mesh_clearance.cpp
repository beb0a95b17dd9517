#include "systems/mesh_clearance.h"

#include <array>

#include "systems/mesh_pose.h"

namespace pleat {
namespace {

constexpr float kFlatSlope = 0.02f;  // up to which the body around a closest point may rise above it
constexpr float kTouching = 1e-5f;   // m; nearer than this the body's own normal is better than the difference
constexpr std::size_t kPlanesPerTriangle = 8;  // of a drawn triangle against one body

/// How far a drawn vertex is from its place on the coarse triangle, at most, as it counts for a body that is above or
/// below that: of what leads away from the body, only what is sideways can bring it closer.
struct Bulge {
  float up = 0.0f, down = 0.0f, reach = 0.0f;  // m

  void include(const Vec3& moved, const Vec3& normal) {
    const float rise = dot(moved, normal), aside = length(moved - normal * rise);
    up = std::max(up, std::max(rise, 0.0f) + aside);
    down = std::max(down, std::max(-rise, 0.0f) + aside);
    reach = std::max(up, down);
  }
  float towards(const NearTriangle& body) const { return body.above > 0.0f ? up : body.below > 0.0f ? down : reach; }
};

/// One mesh against one cloth, face by face.
struct MeshTest {
  const MeshClearance& in;
  MeshPose pose;
  std::uint32_t mesh;
  float kept = in.clearance + pose.mesh.thickness;

  void gather(std::uint32_t f) const {
    const std::uint32_t* drawn = in.pattern->face_vertices.data() + std::size_t{f} * in.pattern->vertices_per_face;
    const Vec3 a = in.footprint[drawn[0]], b = in.footprint[drawn[1]], c = in.footprint[drawn[2]];
    const Vec3 normal = normalized_or(cross(b - a, c - a), Vec3{});
    Bulge bulge;
    for (std::uint32_t i = 0; i < in.pattern->vertices_per_face; ++i) include(bulge, drawn[i], normal);
    const std::uint32_t count = find_near(MeshPose::Corners{a, b, c}, normal, bulge);
    if (count == 0) return;
    const std::uint32_t* t = in.pattern->face_triangles.data();
    const std::uint32_t* const end = t + in.pattern->face_triangles.size();
    for (; t != end; t += 3) test_triangle({drawn[t[0]], drawn[t[1]], drawn[t[2]]}, normal, count);
  }

 private:
  struct Found {
    ClearancePlane plane;
    float distance2;
    bool outside;
  };

  void include(Bulge& bulge, std::uint32_t v, const Vec3& normal) const {
    bulge.include(in.drawn_position[v] - in.footprint[v], normal);
  }

  /// The body's triangles from which some drawn vertex of the face may be too near.
  std::uint32_t find_near(const MeshPose::Corners& face, const Vec3& normal, const Bulge& bulge) const {
    const Box box = face.box().grown(kept + bulge.reach);
    if (!box.moved(in.origin).overlaps(in.bodies->swept_box(mesh))) return 0;
    std::uint32_t count = 0;
    in.bodies->for_each_triangle(mesh, box.moved(in.origin), [&](std::uint32_t t) {
      const MeshPose::Corners at = pose.corners(t);
      const float a = dot(at.a - face.a, normal), b = dot(at.b - face.a, normal), c = dot(at.c - face.a, normal);
      const float low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
      NearTriangle found{};
      found.above = std::max(low, 0.0f), found.below = std::max(-high, 0.0f);
      if (std::max(found.above, found.below) >= kept + bulge.towards(found) || !box.overlaps(at.box())) return;
      if (count == in.near_capacity) return;
      found.index = t;
      found.normal = at.normal();
      for (int k = 0; k < 3; ++k) {
        found.corner[k] = at[k];
        found.aside[k] = normalized_or(cross(at[(k + 1) % 3] - at[k], found.normal), Vec3{});
      }
      in.near[count++] = found;
    });
    return count;
  }

  void test_triangle(const std::array<std::uint32_t, 3>& drawn, const Vec3& normal, std::uint32_t count) const {
    const Vec3 corner[] = {in.footprint[drawn[0]], in.footprint[drawn[1]], in.footprint[drawn[2]]};
    Bulge bulge;
    for (const std::uint32_t v : drawn) include(bulge, v, normal);
    const Box box = MeshPose::Corners{corner[0], corner[1], corner[2]}.box().grown(kept + bulge.reach);
    std::array<Found, kPlanesPerTriangle> found;
    std::size_t planes = 0;
    const auto nearer = [](const Found& a, const Found& b) { return a.distance2 < b.distance2; };
    for (const NearTriangle* body = in.near; body != in.near + count; ++body) {
      const float limit = kept + bulge.towards(*body);
      if (std::max(body->above, body->below) >= limit) continue;
      const MeshPose::Corners at{body->corner[0], body->corner[1], body->corner[2]};
      if (!box.overlaps(at.box()) || body->apart_from(corner[0], corner[1], corner[2]) >= limit) continue;
      Found next;
      if (!meet(corner, *body, at, limit, next)) continue;
      if (planes < found.size()) {
        found[planes++] = next;
      } else if (Found& farthest = *std::ranges::max_element(found, nearer); nearer(next, farthest)) {
        farthest = next;
      }
    }
    // From inside, only the nearest way out is right; from outside, what faces away is a far side.
    Found* const nearest = std::min_element(found.data(), found.data() + planes, nearer);
    for (Found* p = found.data(); p != found.data() + planes; ++p) {
      if (p != nearest && !(nearest->outside && p->outside)) continue;
      std::copy(drawn.begin(), drawn.end(), p->plane.vertex);
      in.planes.add(p->plane, in.drawn_position);
    }
  }

  /// The plane between a footprint and a triangle of the body, or false where none is needed.
  bool meet(const Vec3 (&corner)[3], const NearTriangle& body, const MeshPose::Corners& at, float limit,
            Found& found) const {
    const TrianglePair pair = closest_between_triangles(corner, body.corner);
    const Vec3 surface = pair.second.point(at.a, at.b, at.c);
    const Vec3 away = pair.first.point(corner[0], corner[1], corner[2]) - surface;
    const float distance2 = dot(away, away);
    if (distance2 >= limit * limit) return false;
    const bool touches = distance2 < kTouching * kTouching;
    if (!touches && !is_extreme(body.index, pair.second, surface, away)) return false;
    const Vec3 outward = pair.second.zeros() == 0 ? body.normal : pose.outward(body.index, pair.second).normal;
    const float side = dot(away, outward) < 0.0f ? -1.0f : 1.0f;
    const bool own_normal = touches || pair.second.zeros() == 0;
    const Vec3 normal = normalized_or(own_normal ? outward : away * side, Vec3{});
    if (normal == Vec3{}) return false;
    if (side < 0.0f && distance2 > pose.mesh.depth * pose.mesh.depth) return false;
    found = {{normal, dot(normal, surface) + kept, {}}, distance2, side > 0.0f};
    return true;
  }

  /// The body does not come closer in the triangles around the point, seen in the direction `away`.
  bool is_extreme(std::uint32_t t, const Barycentrics& w, const Vec3& surface, const Vec3& away) const {
    if (w.zeros() == 0) return true;
    const Vec3 direction = normalized_or(away, Vec3{});
    if (w.zeros() == 2) return pose.is_extreme(pose.corner(t, w.corner()), direction, kFlatSlope);
    const std::uint32_t across = pose.topology.neighbour[3 * t + static_cast<std::uint32_t>(w.edge())];
    if (across == kNoTriangle) return true;
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = pose.vertex(pose.corner(across, k)) - surface;
      if (dot(d, direction) > kFlatSlope * length(d)) return false;
    }
    return true;
  }
};

}  // namespace

bool MeshClearance::validate() const {
  return garment != nullptr && pattern != nullptr && footprint.x != nullptr && bodies != nullptr &&
         (meshes != nullptr || bodies->mesh_count() == 0) && t >= 0.0f && t <= 1.0f && clearance >= 0.0f &&
         (near != nullptr || near_capacity == 0) && planes.validate() && drawn_position.x != nullptr;
}

void MeshClearance::run() const {
  const Box cloth = box_of(drawn_position, pattern->vertex_count).with(box_of(footprint, pattern->vertex_count));
  for (std::uint32_t m = 0; m < bodies->mesh_count(); ++m) {
    const MeshTest test{*this, {*meshes[m], bodies->topology(m), t, t, origin}, m};
    if (!meshes[m]->enabled || !cloth.grown(test.kept).moved(origin).overlaps(bodies->swept_box(m))) continue;
    for (std::uint32_t f = 0; f < garment->face_count; ++f) test.gather(f);
  }
}

}  // namespace pleat
