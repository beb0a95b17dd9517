#include "systems/closeness.h"

#include <algorithm>

#include "systems/facing.h"

namespace pleat {
namespace {

constexpr int kRootSteps = 4;

using Facing = FacingT<float>;

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
