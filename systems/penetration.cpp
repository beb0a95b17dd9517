#include "systems/penetration.h"

#include "systems/capsule_shape.h"
#include "systems/mesh_pose.h"

namespace pleat {
namespace {

constexpr float kRounding = 1e-6f;  // m
constexpr int kSampleSteps = 8;     // (8 + 1) (8 + 2) / 2 = 45 points of a triangle, corners and edges among them

struct InCapsule {
  static constexpr bool kExactTriangles = true;
  CapsulePose pose;
  Box box = Box{}.with({pose.a, pose.a}).with({pose.b, pose.b}).grown(widest_radius(pose));

  float distance(const Vec3& p) const { return signed_distance(p, pose); }
  float distance(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const float gap = gap_to_triangle(pose, a, b, c).distance;
    const Vec3 u = b - a, v = c - a, area = cross(u, v);
    const float from = dot(pose.a - a, area), to = dot(pose.b - a, area);
    if ((from < 0.0f) == (to < 0.0f)) return gap;
    const float t = from / (from - to);  // the core goes through the triangle's plane
    const Vec3 w = lerp(pose.a, pose.b, t) - a;
    const float wb = dot(cross(w, v), area), wc = dot(cross(u, w), area);
    const bool pierces = wb >= 0.0f && wc >= 0.0f && wb + wc <= dot(area, area);
    return pierces ? std::min(gap, -radius_at(pose, t)) : gap;
  }
};

struct InPlane {
  static constexpr bool kExactTriangles = true;
  PlanePose pose;
  Box box{{-1e30f, -1e30f, -1e30f}, {1e30f, 1e30f, 1e30f}};

  float distance(const Vec3& p) const { return dot(pose.normal, p) - pose.height; }
  float distance(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return std::min({distance(a), distance(b), distance(c)});
  }
};

struct InMesh {
  static constexpr bool kExactTriangles = false;
  MeshPose pose;
  const CollisionBodies& bodies;
  std::uint32_t index;
  Box box = bodies.swept_box(index).moved(pose.origin * -1.0f);

  /// Looks further and further; beyond the body's size nothing can be inside.
  float distance(const Vec3& p) const {
    const float size = length(box.high - box.low);
    for (float reach = std::min(0.02f, size); reach < 4.0f * size; reach *= 2.0f) {
      float least2 = reach * reach;
      std::uint32_t nearest = kNoTriangle;
      Barycentrics at{};
      bodies.for_each_triangle(index, Box{p, p}.grown(reach).moved(pose.origin), [&](std::uint32_t t) {
        const MeshPose::Corners body = pose.corners(t);
        const Barycentrics here = closest_on_triangle(p, body.a, body.b, body.c);
        const Vec3 away = p - here.point(body.a, body.b, body.c);
        if (dot(away, away) < least2) nearest = t, at = here, least2 = dot(away, away);
      });
      if (nearest == kNoTriangle) continue;
      const MeshPose::Corners body = pose.corners(nearest);
      const auto [outward, on_face, border] = pose.outward(nearest, at);
      const bool inside = !border && dot(p - at.point(body.a, body.b, body.c), outward) < 0.0f;
      return inside ? -std::sqrt(least2) : std::sqrt(least2);
    }
    return size;
  }
  float distance(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 center = (a + b + c) * (1.0f / 3.0f);
    float least = distance(center);
    if (least > std::max({length(a - center), length(b - center), length(c - center)})) return least;
    for (int i = 0; i <= kSampleSteps; ++i) {
      for (int j = 0; i + j <= kSampleSteps; ++j) {
        constexpr float kStep = 1.0f / kSampleSteps;
        const float of_b = kStep * static_cast<float>(i), of_c = kStep * static_cast<float>(j);
        least = std::min(least, distance(a * (1.0f - of_b - of_c) + b * of_b + c * of_c));
      }
    }
    return least;
  }
};

template <class Body>
bool may_meet(const Body& body, const Vec3& p) {
  return body.box.overlaps({p, p});
}

/// The depth of triangle abc, but no less than `depth`.
template <class Body>
float deeper(const Body& body, float depth, const Vec3& a, const Vec3& b, const Vec3& c) {
  Box around{a, a};
  around.include(b);
  around.include(c);
  return body.box.overlaps(around) ? std::max(depth, -body.distance(a, b, c)) : depth;
}

/// The depth of any edge whose two ends are pinned, but no less than `depth`.
template <class Body>
float depth_between_pins(const Penetration& in, const Body& body, float depth) {
  const Garment& g = *in.garment;
  if (g.pins.size() < 2) return depth;
  for (std::uint32_t e = 0; e < g.edge_count; ++e) {
    const std::uint32_t i = g.edge_particle[0][e], j = g.edge_particle[1][e];
    if (g.pinned[i] == 0 || g.pinned[j] == 0) continue;
    depth = deeper(body, depth, in.position[i], in.position[j], in.position[j]);
  }
  return depth;
}

template <class Body>
float depth_of_faces(const Penetration& in, const Body& body) {
  float depth = 0.0f;
  const auto& corner = in.garment->face_particle;
  for (std::uint32_t f = 0; f < in.garment->face_count; ++f) {
    depth = deeper(body, depth, in.position[corner[0][f]], in.position[corner[1][f]], in.position[corner[2][f]]);
  }
  return depth;
}

template <class Body>
float depth_of_drawn(const Penetration& in, const Body& body) {
  float depth = 0.0f;
  const ConstVec3View x = in.drawn_position;
  if constexpr (Body::kExactTriangles) {
    const Column<std::uint32_t>& index = in.pattern->indices;
    const auto at = [&](std::size_t k) { return x[in.pattern->place(index[k])]; };
    for (std::size_t k = 0; k < index.size(); k += 3) depth = deeper(body, depth, at(k), at(k + 1), at(k + 2));
  } else {
    for (std::uint32_t v = 0; v < in.pattern->vertex_count; ++v) {
      if (may_meet(body, x[v])) depth = std::max(depth, -body.distance(x[v]));
    }
  }
  return depth;
}

/// visit(body, kind, index) for every body that the cloth meets.
template <class Visit>
void for_each_body(const Penetration& in, const Visit& visit) {
  for (std::uint32_t i = 0; in.capsules != nullptr && i < in.capsules->size(); ++i) {
    const CapsuleColumns& c = *in.capsules;
    if (!c.meets(i, in.collides_with)) continue;
    const auto at = [&](const Vec3Column& previous, const Vec3Column& next) {
      return lerp(previous.view()[i] - in.origin, next.view()[i] - in.origin, in.t);
    };
    CapsulePose pose{.a = at(c.previous_a, c.next_a),
                     .b = at(c.previous_b, c.next_b),
                     .step_a = {},
                     .step_b = {},
                     .radius = c.radius[i],
                     .taper = c.taper[i]};
    drop_swallowed_end(pose);
    visit(InCapsule{pose}, ColliderKind::kCapsule, i);
  }
  for (std::uint32_t i = 0; i < in.plane_count; ++i) {
    PlaneCollider plane = in.planes[i];
    plane.thickness = 0.0f;
    if (plane.meets(in.collides_with)) visit(InPlane{PlanePose(plane, in.t, in.origin)}, ColliderKind::kPlane, i);
  }
  for (std::uint32_t i = 0; in.bodies != nullptr && i < in.bodies->mesh_count(); ++i) {
    if (!in.meshes[i]->meets(in.collides_with)) continue;
    visit(InMesh{{*in.meshes[i], in.bodies->topology(i), in.t, in.t, in.origin}, *in.bodies, i}, ColliderKind::kMesh,
          i);
  }
}

}  // namespace

bool Penetration::validate() const {
  return garment != nullptr && position.x != nullptr && (pattern == nullptr || drawn_position.x != nullptr) &&
         (planes != nullptr || plane_count == 0) &&
         (bodies == nullptr || bodies->mesh_count() == 0 || meshes != nullptr) && t >= 0.0f && t <= 1.0f;
}

PenetrationDepths Penetration::run() const {
  PenetrationDepths all;
  float deepest = 0.0f;
  for_each_body(*this, [&](const auto& body, ColliderKind kind, std::uint32_t index) {
    float of_particles = 0.0f, of_pins = 0.0f;
    for (std::uint32_t i = 0; i < garment->particle_count; ++i) {
      if (!may_meet(body, position[i])) continue;
      float& depth = garment->pinned[i] != 0 ? of_pins : of_particles;
      depth = std::max(depth, -body.distance(position[i]));
    }
    of_pins = depth_between_pins(*this, body, of_pins);
    const float of_faces = depth_of_faces(*this, body);
    const float of_drawn = pattern != nullptr ? depth_of_drawn(*this, body) : of_faces;
    all.particle = std::max(all.particle, of_particles);
    all.pin = std::max(all.pin, of_pins);
    all.face = std::max(all.face, of_faces);
    all.drawn = std::max(all.drawn, of_drawn);
    const float depth = std::max({of_particles, of_pins, of_faces, of_drawn});
    if (depth > deepest) all.deepest = {kind, index}, deepest = depth;
  });
  for (const std::uint32_t pin : garment->pins) {
    float depth = 0.0f;
    for_each_body(*this, [&](const auto& body, ColliderKind, std::uint32_t) {
      if (may_meet(body, position[pin])) depth = std::max(depth, -body.distance(position[pin]));
    });
    if (depth > kRounding) ++all.pins_inside;
  }
  return all;
}

}  // namespace pleat
