#include "systems/mesh_pose.h"

#include <numbers>

#include "components/lanes.h"

namespace pleat {
namespace {

/// atan2(y, x) of y >= 0, within 1e-5 (M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, 1964, 4.4.49).
PLEAT_KERNEL Lanes angle_of(const Lanes& y, const Lanes& x) {
  constexpr float kPi = std::numbers::pi_v<float>, kLeast = 1e-37f;
  const Lanes wide = abs(x), most = max(max(y, wide), all(kLeast)), t = min(y, wide) / most, t2 = t * t;
  const Lanes flat = t * (.9998660f + t2 * (-.3302995f + t2 * (.1801410f + t2 * (-.0851330f + t2 * .0208351f))));
  const Lanes acute = y > wide ? .5f * kPi - flat : flat;
  return x < 0.0f ? kPi - acute : acute;
}

}  // namespace

MeshPose::Ring MeshPose::look_around(std::uint32_t v, const Vec3& direction, float tolerance) const {
  Ring ring{};
  run_wide(widest_vectors(), [&] {
    const Vec3Lanes at = all(vertex(v)), up = all(direction);
    Vec3Lanes normals{};
    LaneMask rises{}, falls{};
    const std::uint32_t last = topology.ring_begin[v + 1];
    for (std::uint32_t r = topology.ring_begin[v]; r < last; r += kLanes) {
      std::uint32_t beside[2][kLanes];
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t* t = mesh.triangles.data() + 3 * std::size_t{topology.ring[std::min(r + lane, last - 1)]};
        const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        for (std::size_t s = 0; s < 2; ++s) beside[s][lane] = t[(k + 1 + s) % 3];
      }
      const Vec3Lanes side[2] = {vertices(beside[0]) - at, vertices(beside[1]) - at};
      for (const Vec3Lanes& d : side) {
        const Lanes rise = dot(d, up);
        const LaneMask steep = rise * rise > tolerance * tolerance * dot(d, d);
        rises |= steep & (rise > 0.0f), falls |= steep & (rise < 0.0f);
      }
      const Vec3Lanes area = cross(side[0], side[1]);
      const Lanes size = length(area), angle = angle_of(size, dot(side[0], side[1]));
      const LaneMask counts = first_lanes(last - r) & (size > 1e-12f);
      normals += area * (counts ? angle / (counts ? size : all(1.0f)) : Lanes{});
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      ring.normal += Vec3{normals.x[lane], normals.y[lane], normals.z[lane]};
    }
    ring.rises = any(rises), ring.falls = any(falls);
  });
  return ring;
}

Vec3 MeshPose::edge_normal(std::uint32_t triangle, int k) const {
  const std::uint32_t across = topology.neighbour[3 * triangle + static_cast<std::uint32_t>(k)];
  const Vec3 normal = corners(triangle).normal();
  return across == kNoTriangle ? normal : normal + corners(across).normal();
}

MeshPose::Outward MeshPose::outward(std::uint32_t triangle, const Barycentrics& at) const {
  if (at.zeros() == 2) return {look_around(corner(triangle, at.corner()), {}, 0.0f).normal, false, false};
  if (at.zeros() == 0) return {corners(triangle).normal(), true, false};
  const int k = at.edge();
  const bool border = topology.neighbour[3 * triangle + static_cast<std::uint32_t>(k)] == kNoTriangle;
  return {edge_normal(triangle, k), false, border};
}

}  // namespace pleat
