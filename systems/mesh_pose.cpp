#include "systems/mesh_pose.h"

namespace pleat {

Vec3 MeshPose::vertex_normal(std::uint32_t v) const {
  Vec3 sum;
  for (std::uint32_t r = topology.ring_begin[v]; r < topology.ring_begin[v + 1]; ++r) {
    const std::uint32_t triangle = topology.ring[r];
    const int k = corner(triangle, 0) == v ? 0 : corner(triangle, 1) == v ? 1 : 2;
    const Corners at = corners(triangle);
    const Vec3 u = at[(k + 1) % 3] - at[k], w = at[(k + 2) % 3] - at[k], area = cross(u, w);
    sum += normalized_or(area, Vec3{}) * std::atan2(length(area), dot(u, w));
  }
  return sum;
}

Vec3 MeshPose::edge_normal(std::uint32_t triangle, int k) const {
  const std::uint32_t across = topology.neighbour[3 * triangle + static_cast<std::uint32_t>(k)];
  const Vec3 normal = corners(triangle).normal();
  return across == kNoTriangle ? normal : normal + corners(across).normal();
}

MeshPose::Outward MeshPose::outward(std::uint32_t triangle, const Barycentrics& at) const {
  if (at.zeros() == 2) return {vertex_normal(corner(triangle, at.corner())), false, false};
  if (at.zeros() == 0) return {corners(triangle).normal(), true, false};
  const int k = at.edge();
  const bool border = topology.neighbour[3 * triangle + static_cast<std::uint32_t>(k)] == kNoTriangle;
  return {edge_normal(triangle, k), false, border};
}

bool MeshPose::is_extreme(std::uint32_t v, const Vec3& normal, float tolerance) const {
  const Vec3 at = vertex(v);
  for (std::uint32_t r = topology.ring_begin[v]; r < topology.ring_begin[v + 1]; ++r) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = vertex(corner(topology.ring[r], k)) - at;
      const float rise = dot(d, normal);
      if (rise > 0.0f && rise * rise > tolerance * tolerance * dot(d, d)) return false;
    }
  }
  return true;
}

}  // namespace pleat
