#include "systems/closeness.h"

#include <algorithm>

#include "systems/closest_points.h"

namespace pleat {
namespace {

/// Faces reach so far beyond their border, so that there is no gap where a particle lies on an edge.
constexpr float kOverlap = 0.05f;
constexpr float kLeastSine2 = 0.01f;  // between edges
constexpr int kRootSteps = 4;

/// The points where two features face each other.
struct Facing {
  float weight[4];
  Vec3 area;     // along the normal
  float area2;   // 0 where there is none
  float volume;  // six times that of the tetrahedron: its sign is the side
  bool over;
};

Facing face_particle(const Vec3 (&x)[4]) {
  const Vec3 u = x[2] - x[1], v = x[3] - x[1], w = x[0] - x[1];
  Facing f{{}, cross(u, v), 0.0f, 0.0f, false};
  f.volume = dot(w, f.area);
  const float area2 = dot(f.area, f.area);
  if (!(area2 > 1e-16f)) return f;
  f.area2 = area2;
  const float b = dot(cross(w, v), f.area) / area2, c = dot(cross(u, w), f.area) / area2, a = 1.0f - b - c;
  f.weight[0] = 1.0f, f.weight[1] = -a, f.weight[2] = -b, f.weight[3] = -c;
  f.over = std::min({a, b, c}) > -kOverlap;
  return f;
}

Facing face_edge(const Vec3 (&x)[4]) {
  const Vec3 u = x[1] - x[0], v = x[3] - x[2], w = x[0] - x[2];
  Facing f{{}, cross(u, v), 0.0f, 0.0f, false};
  f.volume = dot(w, f.area);
  const float area2 = dot(f.area, f.area);
  if (!(area2 > 1e-16f && area2 > kLeastSine2 * dot(u, u) * dot(v, v))) return f;
  f.area2 = area2;
  const float s = dot(cross(v, w), f.area) / area2, t = dot(cross(u, w), f.area) / area2;
  f.weight[0] = 1.0f - s, f.weight[1] = s, f.weight[2] = t - 1.0f, f.weight[3] = -t;
  f.over = std::min({s, 1.0f - s, t, 1.0f - t}) > 0.0f;
  return f;
}

Facing facing(NearKind kind, const Vec3 (&x)[4]) { return kind == NearKind::kEdges ? face_edge(x) : face_particle(x); }

/// At the moment between `before` and x when the four points lie in one plane, found by false position.
Facing meeting(NearKind kind, const Vec3 (&before)[4], const Vec3 (&x)[4], float volume_before, float volume) {
  float t0 = 0.0f, t1 = 1.0f, v0 = volume_before, v1 = volume;
  Facing at{};
  for (int step = 0; step < kRootSteps; ++step) {
    const float t = t0 + (t1 - t0) * v0 / (v0 - v1);
    const Vec3 then[4] = {lerp(before[0], x[0], t), lerp(before[1], x[1], t), lerp(before[2], x[2], t),
                          lerp(before[3], x[3], t)};
    at = facing(kind, then);
    if ((at.volume < 0.0f) == (v0 < 0.0f)) {
      t0 = t, v0 = at.volume;
    } else {
      t1 = t, v1 = at.volume;
    }
  }
  return at;
}

}  // namespace

bool closeness(NearKind kind, const Vec3 (&x)[4], const Vec3 (&before)[4], float& side, Closeness& out) {
  Facing at = facing(kind, x);
  if (!at.over || side == 0.0f) {
    const float volume = at.volume, volume_before = facing(kind, before).volume;
    side = volume < 0.0f ? -1.0f : 1.0f;
    if ((volume < 0.0f) != (volume_before < 0.0f)) {
      const Facing met = meeting(kind, before, x, volume_before, volume);
      if (met.over) at = met, side = -side;
    }
    if (!at.over) {
      side = 0.0f;
      return false;
    }
  }
  out.normal = at.area * (side / std::sqrt(at.area2));
  std::copy(at.weight, at.weight + 4, out.weight);
  out.distance = 0.0f;
  for (int k = 0; k < 4; ++k) out.distance += out.weight[k] * dot(out.normal, x[k]);
  return true;
}

}  // namespace pleat
