#include "systems/mesh_pairs.h"

#include <algorithm>

#include "components/lanes.h"
#include "systems/mesh_facing.h"

namespace pleat {
namespace {

/// Of a point to the segment from the origin to `along`.
PLEAT_KERNEL Lanes distance2_to_segment(const Vec3Lanes& p, const Vec3Lanes& along) {
  constexpr float kLeast = 1e-30f;  // m2
  const Vec3Lanes away = p - along * clamped(dot(p, along) / max(dot(along, along), all(kLeast)));
  return dot(away, away);
}

PLEAT_KERNEL Lanes distance2_to_triangle(const Vec3Lanes& p, const Vec3Lanes (&x)[3]) {
  constexpr float kLeastSine2 = 1e-7f;  // of thinner triangles the sides are near enough
  const Vec3Lanes ab = x[1] - x[0], ac = x[2] - x[0], ap = p - x[0], area = cross(ab, ac);
  const Lanes area2 = dot(area, area), c = dot(cross(ab, ap), area), b = dot(cross(ap, ac), area);
  const LaneMask over =
      (area2 > kLeastSine2 * dot(ab, ab) * dot(ac, ac)) & (min(min(b, c), area2 - b - c) >= 0.0f) & (area2 > 0.0f);
  const Lanes height = dot(ap, area);
  const Lanes sides =
      min(min(distance2_to_segment(ap, ab), distance2_to_segment(ap, ac)), distance2_to_segment(p - x[1], x[2] - x[1]));
  return over ? height * height / (over ? area2 : all(1.0f)) : sides;
}

/// Calls kernel(eight of them, how many of these count, where in the list they begin).
template <class Pair, class Kernel>
PLEAT_KERNEL void for_each_eight(std::span<const Pair> pairs, const Kernel& kernel) {
  std::size_t begin = 0;
  for (; begin + kLanes <= pairs.size(); begin += kLanes) kernel(pairs.data() + begin, kLanes, begin);
  if (begin == pairs.size()) return;
  Pair last[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) last[lane] = pairs[std::min(begin + lane, pairs.size() - 1)];
  kernel(last, pairs.size() - begin, begin);
}

PLEAT_KERNEL std::uint8_t first_bits(std::uint8_t bits, std::size_t count) {
  return static_cast<std::uint8_t>(bits & ((1u << count) - 1));
}

}  // namespace

void MeshPairs::measure(std::span<const MeshParticlePair> pairs, float* distance2) const {
  run_wide(widest_vectors(), [&] {
    for_each_eight(pairs, [&](const MeshParticlePair* pair, std::size_t, std::size_t begin) PLEAT_KERNEL_LAMBDA {
      std::uint32_t particle[kLanes], vertex[3][kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const MeshParticlePair& p = pair[lane];
        particle[lane] = garment.face_particle[p.corner % 3][p.corner / 3];
        for (std::size_t k = 0; k < 3; ++k) vertex[k][lane] = triangles[3 * p.triangle + k];
      }
      const Vec3Lanes x[3] = {gather(body, vertex[0]).vector, gather(body, vertex[1]).vector,
                              gather(body, vertex[2]).vector};
      store(distance2_to_triangle(gather(position, particle).vector, x), distance2 + begin);
    });
  });
}

void MeshPairs::find_near(std::span<const MeshVertexPair> pairs, std::uint8_t* near) const {
  run_wide(widest_vectors(), [&] {
    for_each_eight(pairs, [&](const MeshVertexPair* pair, std::size_t some, std::size_t begin) PLEAT_KERNEL_LAMBDA {
      std::uint32_t particle[3][kLanes], vertex[kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const MeshVertexPair& p = pair[lane];
        for (std::size_t k = 0; k < 3; ++k) particle[k][lane] = garment.face_particle[k][p.face];
        vertex[lane] = p.vertex;
      }
      const Vec3Lanes x[3] = {gather(position, particle[0]).vector, gather(position, particle[1]).vector,
                              gather(position, particle[2]).vector};
      const Vec3Lanes q = gather(body, vertex).vector;
      LaneMask meets = VertexOverFace<Lanes>(x, q).within(reach);
      for (std::size_t i = 0; i < 3; ++i) meets = meets | VertexAtEdge<Lanes>(x[i], x[(i + 1) % 3], q).within(reach);
      near[begin / kLanes] = first_bits(bits(meets), some);
    });
  });
}

void MeshPairs::find_near(std::span<const MeshEdgePair> pairs, std::uint8_t* near) const {
  run_wide(widest_vectors(), [&] {
    for_each_eight(pairs, [&](const MeshEdgePair* pair, std::size_t some, std::size_t begin) PLEAT_KERNEL_LAMBDA {
      std::uint32_t end[2][kLanes], vertex[2][kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const MeshEdgePair& p = pair[lane];
        for (std::size_t k = 0; k < 2; ++k) end[k][lane] = p.particle[k], vertex[k][lane] = p.ridge.vertex[k];
      }
      const EdgesFacing<Lanes> at(gather(position, end[0]).vector, gather(position, end[1]).vector,
                                  gather(body, vertex[0]).vector, gather(body, vertex[1]).vector);
      near[begin / kLanes] = first_bits(bits(at.within(reach)), some);
    });
  });
}

void MeshPairs::find_met(std::span<const MeshEdgePair> pairs, std::uint8_t* met) const {
  run_wide(widest_vectors(), [&] {
    for_each_eight(pairs, [&](const MeshEdgePair* pair, std::size_t some, std::size_t begin) PLEAT_KERNEL_LAMBDA {
      std::uint32_t end[2][kLanes], vertex[4][kLanes];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const MeshEdgePair& p = pair[lane];
        for (std::size_t k = 0; k < 2; ++k) end[k][lane] = p.particle[k];
        for (std::size_t k = 0; k < 4; ++k) vertex[k][lane] = p.ridge.vertex[k];
      }
      const Vec3Lanes p0 = gather(position, end[0]).vector, p1 = gather(position, end[1]).vector;
      const Vec3Lanes q[4] = {gather(body, vertex[0]).vector, gather(body, vertex[1]).vector,
                              gather(body, vertex[2]).vector, gather(body, vertex[3]).vector};
      const RidgeFacing<Lanes> ridge(EdgesFacing<Lanes>(p0, p1, q[0], q[1]), p0, p1, q);
      met[begin / kLanes] = first_bits(bits(ridge.met), some);
    });
  });
}

}  // namespace pleat
