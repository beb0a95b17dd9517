// The shape of a mesh body at one moment of a tick.
#pragma once

#include "components/garment.h"
#include "components/mesh_candidates.h"
#include "systems/body_topology.h"
#include "systems/box.h"
#include "systems/closest_points.h"

namespace pleat {

/// How far from a particle to look for a body, m. Ones that start deep are looked for in a tick's first substep only.
inline float mesh_search(const MeshCollider& mesh, float reach, float t0) {
  return t0 == 0.0f ? std::max(reach, mesh.depth) : reach;
}

/// By how much boxes may be off around a place in the world, m.
inline float box_rounding(const Vec3& at) { return 1e-6f * (10.0f + std::abs(at.x) + std::abs(at.y) + std::abs(at.z)); }

/// Features of a cloth are measured as part of one of the faces around them, and pinned particles as part of none.
inline bool owns_particle(const Garment& garment, const float* inverse_mass, std::uint32_t face, std::size_t c) {
  const std::uint32_t i = garment.face_particle[c][face];
  return garment.faces_around[garment.around_begin[i]] == face && inverse_mass[i] > 0.0f;
}
inline bool owns_edge(const Garment& garment, std::uint32_t face, std::size_t c) {
  return garment.edge_face[0][garment.face_edge[c][face]] == face;
}

/// Edge k of a triangle; false at a border, over which it cannot be told what is outside.
inline bool find_ridge(const MeshCollider& mesh, const BodyTopology& topology, std::uint32_t triangle, int k,
                       Ridge& ridge) {
  const auto corner = [&](std::uint32_t t, int c) { return mesh.triangles[3 * t + static_cast<std::uint32_t>(c)]; };
  const std::uint32_t across = topology.neighbour[3 * triangle + static_cast<std::uint32_t>(k)];
  if (across == kNoTriangle) return false;
  const std::uint32_t a = corner(triangle, k), b = corner(triangle, (k + 1) % 3);
  ridge = {{a, b, corner(triangle, (k + 2) % 3), a}};
  for (int c = 0; c < 3; ++c) {
    if (corner(across, c) != a && corner(across, c) != b) ridge.vertex[3] = corner(across, c);
  }
  return true;
}

struct MeshPose {
  const MeshCollider& mesh;
  const BodyTopology& topology;
  float t0, t1;   // fractions of the tick; the pose is the one at t1
  Vec3 origin{};  // from which it is seen, m in the world
  ConstVec3View previous = mesh.previous.view(), next = mesh.next.view(), local = mesh.local.view();
  bool rigid = mesh.is_rigid();
  RigidPose begin = interpolate(mesh.previous_pose.from(origin), mesh.next_pose.from(origin), t0);
  RigidPose end = interpolate(mesh.previous_pose.from(origin), mesh.next_pose.from(origin), t1);

  std::uint32_t corner(std::uint32_t triangle, int k) const {
    return mesh.triangles[3 * triangle + static_cast<std::uint32_t>(k)];
  }
  Vec3 vertex(std::uint32_t v) const {
    return rigid ? end.apply(local[v]) : lerp(previous[v] - origin, next_vertex(v), t1);
  }
  /// Eight of them, with the same bits.
  PLEAT_KERNEL Vec3Lanes vertices(const std::uint32_t* v) const {
    if (rigid) {
      const Vec3Lanes at = gather(local, v), axis = all({end.rotation.x, end.rotation.y, end.rotation.z});
      const Vec3Lanes turn = cross(axis, at) * 2.0f;
      return all(end.position) + (at + (turn * end.rotation.w + cross(axis, turn)));
    }
    const Vec3Lanes from = gather(previous, v) - all(origin), to = gather(next, v) - all(origin);
    return from + (to - from) * t1;
  }
  /// Where it will be when the tick ends.
  Vec3 next_vertex(std::uint32_t v) const { return next[v] - origin; }
  /// Motion from t0 to t1.
  Vec3 step(std::uint32_t v) const {
    return rigid ? end.apply(local[v]) - begin.apply(local[v]) : (next[v] - previous[v]) * (t1 - t0);
  }

  struct Corners {
    Vec3 a, b, c;
    Vec3 operator[](int k) const { return k == 0 ? a : k == 1 ? b : c; }
    Box box() const {
      Box around{a, a};
      around.include(b);
      around.include(c);
      return around;
    }
    /// Outward, unit; zero where the triangle has no area.
    Vec3 normal() const { return normalized_or(cross(b - a, c - a), Vec3{}); }
  };
  Corners corners(std::uint32_t triangle) const {
    return {vertex(corner(triangle, 0)), vertex(corner(triangle, 1)), vertex(corner(triangle, 2))};
  }

  /// A vertex and the triangles around it.
  struct Ring {
    /// Sum of their normals, each by the angle of its triangle there, within 1e-5: for a point whose nearest point of
    /// the body is this vertex, the sign of the dot product tells inside from outside. Not of unit length.
    Vec3 normal;
    bool rises, falls;  // a neighbour stands out further than the vertex in a direction; against it

    /// None does, along it or, side -1, against it.
    bool stands_out(float side) const { return side < 0.0f ? !falls : !rises; }
  };
  /// direction: unit. What stands out by no more than a slope of `tolerance` does not count.
  Ring look_around(std::uint32_t v, const Vec3& direction, float tolerance) const;
  /// For edge k of a triangle: the sum of its two triangles' normals.
  Vec3 edge_normal(std::uint32_t triangle, int k) const;
  /// The side of a point whose nearest point of the body is `at` on a triangle.
  struct Outward {
    Vec3 normal;   // not of unit length
    bool on_face;  // not on an edge or a vertex
    bool border;   // on an edge without a second triangle: nobody can tell
  };
  Outward outward(std::uint32_t triangle, const Barycentrics& at) const;
};

}  // namespace pleat
