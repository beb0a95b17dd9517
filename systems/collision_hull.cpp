#include "systems/collision_hull.h"

#include <LinearMath/btConvexHullComputer.h>

#include <array>

#include "systems/box.h"

namespace pleat {
namespace {

/// Without triangles where six times its volume is no more than `flat` times the cube of its largest extent.
MeshCollider hull_of(std::span<const Vec3> points, float flat, std::pmr::memory_resource* memory) {
  MeshCollider hull(memory);
  Box box;
  for (const Vec3& p : points) box.include(p);
  const Vec3 extent = box.high - box.low;
  const float size = std::max({extent.x, extent.y, extent.z});
  btConvexHullComputer computer;
  computer.compute(&points[0].x, sizeof(Vec3), static_cast<int>(points.size()), 0.0f, 0.0f);

  // Bullet rounds corners to a grid of its own; the points themselves are better.
  const std::size_t corners = static_cast<std::size_t>(computer.vertices.size());
  for (Vec3Column* column : {&hull.local, &hull.previous, &hull.next}) column->resize(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    const auto original = static_cast<std::size_t>(computer.original_vertex_index[static_cast<int>(i)]);
    for (Vec3Column* column : {&hull.local, &hull.previous, &hull.next}) column->view().set(i, points[original]);
  }
  float volume = 0.0f;  // six times, m3
  for (int f = 0; f < computer.faces.size(); ++f) {
    const btConvexHullComputer::Edge* edge = &computer.edges[computer.faces[f]];
    const auto first = static_cast<std::uint32_t>(edge->getSourceVertex());
    for (edge = edge->getNextEdgeOfFace(); edge->getTargetVertex() != static_cast<int>(first);
         edge = edge->getNextEdgeOfFace()) {
      const std::uint32_t b = static_cast<std::uint32_t>(edge->getSourceVertex()),
                          c = static_cast<std::uint32_t>(edge->getTargetVertex());
      for (const std::uint32_t corner : {first, b, c}) hull.triangles.push_back(corner);
      const ConstVec3View x = hull.local.view();
      volume += dot(x[first] - points[0], cross(x[b] - points[0], x[c] - points[0]));
    }
  }
  if (!(volume > flat * size * size * size)) hull.triangles.resize(0);
  hull.depth = 0.5f * std::min({extent.x, extent.y, extent.z});
  return hull;
}

}  // namespace

MeshCollider build_box(const Vec3& half, std::pmr::memory_resource* memory) {
  std::array<Vec3, 8> corners;
  for (unsigned k = 0; k < 8; ++k) {
    corners[k] = {k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z};
  }
  return hull_of(corners, 0.0f, memory);
}

MeshCollider build_hull(std::span<const Vec3> points, std::pmr::memory_resource* memory) {
  return hull_of(points, 1e-6f, memory);
}

void place_rigid(MeshCollider& body, const RigidPose& pose) {
  body.previous_pose = pose;
  move_rigid(body, pose);
  for (std::size_t i = 0; i < body.next.size(); ++i) body.previous.view().set(i, body.next.view()[i]);
}

void move_rigid(MeshCollider& body, const RigidPose& pose) {
  body.next_pose = pose;
  float furthest2 = 0.0f;
  for (std::size_t i = 0; i < body.local.size(); ++i) {
    const Vec3 p = body.local.view()[i];
    furthest2 = std::max(furthest2, dot(p, p));
    body.next.view().set(i, pose.apply(p));
  }
  // On a circle of radius r an arc of angle a rises r (1 - cos(a / 2)) over its chord; |p . q| is that cosine.
  const float half = std::min(std::abs(dot(body.previous_pose.rotation, pose.rotation)), 1.0f);
  body.bow = std::sqrt(furthest2) * (1.0f - half);
}

}  // namespace pleat
