#include "systems/surface_clearance.h"

#include <algorithm>

#include "systems/closest_points.h"

namespace pleat {
namespace {

constexpr int kMostSweeps = 8;          // one settles planes that agree; opposed ones converge within a few
constexpr float kSettledDepth = 1e-6f;  // m behind a plane that is not worth another sweep

/// A small flat triangle and how far its drawn vertices are from their places on it.
struct Footprint {
  Vec3 a, b, c;
  float bulge;  // m, the largest

  Vec3 center() const { return (a + b + c) * (1.0f / 3.0f); }
};

/// From the nearest point of segment pq to that of the triangle; zero where they touch.
Vec3 from_core(const Footprint& t, const Vec3& p, const Vec3& q) {
  Vec3 nearest = closest_on_triangle(p, t.a, t.b, t.c).point(t.a, t.b, t.c) - p;
  const auto consider = [&nearest](const Vec3& d) {
    if (dot(d, d) < dot(nearest, nearest)) nearest = d;
  };
  if (p == q) return nearest;
  consider(closest_on_triangle(q, t.a, t.b, t.c).point(t.a, t.b, t.c) - q);
  const Vec3 corner[] = {t.a, t.b, t.c, t.a};
  for (int k = 0; k < 3; ++k) {
    const SegmentPair at = closest_between_segments(corner[k], corner[k + 1], p, q);
    consider(lerp(corner[k], corner[k + 1], at.s) - lerp(p, q, at.t));
  }
  return nearest;
}

float distance_to_core(const Vec3& x, const CapsulePose& c) {
  return length(x - lerp(c.a, c.b, closest_on_segment(x, c.a, c.b)));
}

struct Lifter {
  const SurfaceClearance& in;
  std::uint32_t count = 0;

  float squared_bulge(std::uint32_t v) const {
    const Vec3 d = in.drawn_position[v] - in.footprint[v];
    return dot(d, d);
  }

  void gather(std::uint32_t f) {
    const TessellationPattern& pattern = *in.pattern;
    const std::uint32_t* own = pattern.face_vertices.data() + std::size_t{f} * pattern.vertices_per_face;
    float bulge2 = 0.0f;
    for (std::uint32_t v = 0; v < pattern.vertices_per_face; ++v) bulge2 = std::max(bulge2, squared_bulge(own[v]));
    const float bulge = std::sqrt(bulge2);

    const Vec3 a = in.footprint[own[0]], b = in.footprint[own[1]], c = in.footprint[own[2]];
    const Vec3 center = (a + b + c) * (1.0f / 3.0f);
    const float size = std::max({length(a - center), length(b - center), length(c - center)});
    for (std::uint32_t k = 0; k < in.capsule_count; ++k) {
      const float kept = in.capsules[k].radius + in.clearance;
      if (distance_to_core(center, in.capsules[k]) >= kept + size + bulge) continue;
      for (std::size_t t = 0; t < pattern.face_triangles.size(); t += 3) {
        const std::uint32_t* corner = pattern.face_triangles.data() + t;
        add_plane(own[corner[0]], own[corner[1]], own[corner[2]], in.capsules[k], kept);
      }
    }
  }

  void add_plane(std::uint32_t i, std::uint32_t j, std::uint32_t k, const CapsulePose& capsule, float kept) {
    const Vec3 a = in.footprint[i], b = in.footprint[j], c = in.footprint[k];
    const float bulge = std::sqrt(std::max({squared_bulge(i), squared_bulge(j), squared_bulge(k)}));
    const Vec3 center = (a + b + c) * (1.0f / 3.0f);
    const float size = std::max({length(a - center), length(b - center), length(c - center)});
    if (distance_to_core(center, capsule) >= kept + size + bulge) return;
    const Vec3 away = from_core({a, b, c, bulge}, capsule.a, capsule.b);
    const float distance = length(away);
    if (distance >= kept + bulge) return;
    const Vec3 normal = distance > 1e-9f ? away * (1.0f / distance) : normalized_or(cross(b - a, c - a), Vec3{0, 1, 0});
    const float height = std::max(dot(normal, capsule.a), dot(normal, capsule.b)) + kept;
    if (count == in.plane_capacity) settle();
    in.planes[count++] = {normal, height, {i, j, k}};
  }

  void settle() {
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      float deepest = 0.0f;
      for (std::uint32_t p = 0; p < count; ++p) {
        const ClearancePlane& plane = in.planes[p];
        for (const std::uint32_t v : plane.vertex) {
          const float depth = plane.height - dot(plane.normal, in.drawn_position[v]);
          if (depth <= 0.0f) continue;
          in.drawn_position.add(v, plane.normal * depth);
          deepest = std::max(deepest, depth);
        }
      }
      if (deepest <= kSettledDepth) break;
    }
    count = 0;
  }
};

}  // namespace

bool SurfaceClearance::validate() const {
  return garment != nullptr && pattern != nullptr && footprint.x != nullptr &&
         (capsules != nullptr || capsule_count == 0) && clearance >= 0.0f && planes != nullptr && plane_capacity > 0 &&
         drawn_position.x != nullptr;
}

void SurfaceClearance::run() const {
  if (capsule_count == 0) return;
  Lifter lifter{*this};
  for (std::uint32_t f = 0; f < garment->face_count; ++f) lifter.gather(f);
  lifter.settle();
}

}  // namespace pleat
