// Which of a few features of a cloth may be near a capsule, side by side.
#pragma once

#include <limits>

#include "components/capsule_block.h"
#include "components/garment.h"
#include "components/lanes.h"
#include "components/wide.h"
#include "systems/capsule_shape.h"

namespace pleat {

/// m, that the distances of this file may be off by where an edge and a core are nearly parallel.
inline constexpr float kLaneRounding = 1e-3f;

/// A capsule's core, as a rule the same in all lanes, and how far from it a feature is near.
struct Core {
  Vec3Lanes a, b, axis;
  Lanes axis2, inverse;  // m2, 1/m2 or zero
  float reach, reach2;   // m, m2

  PLEAT_KERNEL Core(const CapsulePose& c, float within)
      : a(all(c.a)), b(all(c.b)), axis(b - a), reach(within), reach2(within * within) {
    const Vec3 along = c.b - c.a;
    const float along2 = dot(along, along);
    axis2 = all(along2), inverse = all(along2 > 0.0f ? 1.0f / along2 : 0.0f);
  }
};

/// To the places from where they are nearest to on the core, m.
PLEAT_KERNEL Vec3Lanes away_from(const Core& core, const Vec3Lanes& position) {
  const Vec3Lanes p = position - core.a;
  return p - core.axis * clamped(dot(p, core.axis) * core.inverse);
}

PLEAT_KERNEL Lanes distance2_from(const Core& core, const Vec3Lanes& position) {
  const Vec3Lanes away = away_from(core, position);
  return dot(away, away);
}

struct EdgeLanes {
  Vec3Lanes start, along;

  EdgeLanes() = default;
  PLEAT_KERNEL EdgeLanes(const Vec3Lanes& from, const Vec3Lanes& to) : start(from), along(to - from) {}
};

/// As closest_between_segments, in float: where the two are nearly parallel, off by up to kLaneRounding.
struct EdgeDistance {
  Lanes s, t;        // along the edge, along the core
  Vec3Lanes away;    // from the core to the edge there, m
  Lanes distance2;   // m2
  LaneMask crosses;  // at an angle of more than 2 degrees: then s and t are good to 1e-4

  PLEAT_KERNEL EdgeDistance(const Core& core, const EdgeLanes& edge) {
    const Vec3Lanes w = edge.start - core.a, u = edge.along;
    const Lanes uu = dot(u, u) + 1e-24f, uv = dot(u, core.axis), uw = dot(u, w), vw = dot(core.axis, w);
    const Lanes open = abs(uu * core.axis2 - uv * uv) + 1e-24f;
    const Lanes on_lines = clamped((uv * vw - uw * core.axis2) / open);
    t = clamped((uv * on_lines + vw) * core.inverse), s = clamped((uv * t - uw) / uu);
    away = w + u * s - core.axis * t;
    distance2 = dot(away, away);
    crosses = open > 1e-3f * uu * core.axis2;
  }
};

PLEAT_KERNEL Lanes distance2_from(const Core& core, const EdgeLanes& edge) {
  return EdgeDistance(core, edge).distance2;
}

/// Whose surfaces may be nearer to the core than `room`, m.
PLEAT_KERNEL LaneMask may_press(const CapsuleBlock& capsules, const Core& core, float room) {
  EdgeLanes cores;
  cores.start = capsules.a, cores.along = capsules.axis;
  const Lanes reach = capsules.widest + (room + kLaneRounding);
  return (reach > 0.0f) & (EdgeDistance(core, cores).distance2 < reach * reach);
}

/// Faces by their planes and, within those, the lines of their sides.
struct FaceLanes {
  Vec3Lanes a, b, normal, past_ab, past_bc, past_ca;  // corners, m; unit, the last three out of the face
  Vec3Lanes middle;
  Lanes radius;  // m, of a ball about the middle that holds the face

  PLEAT_KERNEL FaceLanes(const Vec3Lanes& corner, const Vec3Lanes& second, const Vec3Lanes& c) : a(corner), b(second) {
    normal = unit(cross(b - a, c - a));
    past_ab = unit(cross(b - a, normal)), past_bc = unit(cross(c - b, normal)), past_ca = unit(cross(a - c, normal));
    middle = (a + b + c) * (1.0f / 3.0f);
    const Vec3Lanes from_a = middle - a, from_b = middle - b, from_c = middle - c;
    radius = sqrt(max(max(dot(from_a, from_a), dot(from_b, from_b)), dot(from_c, from_c)));
  }

 private:
  static PLEAT_KERNEL Vec3Lanes unit(const Vec3Lanes& v) { return v * (1.0f / (sqrt(dot(v, v)) + 1e-18f)); }
};

/// The squares of how far a point is from the plane and, along it, past the sides: a face is no nearer than their sum.
struct FaceDistance {
  Lanes height2, beside2;

  PLEAT_KERNEL FaceDistance(const FaceLanes& face, const Vec3Lanes& point) {
    const Vec3Lanes from_a = point - face.a, from_b = point - face.b;
    const Lanes height = dot(from_a, face.normal);
    const Lanes past = max(max(dot(from_a, face.past_ab), dot(from_b, face.past_bc)), dot(from_a, face.past_ca));
    const Lanes beside = max(past, Lanes{});
    height2 = height * height, beside2 = beside * beside;
  }
};

/// From the nearer end of the core, no more than it is; where all are out of reach, only that they are.
PLEAT_KERNEL Lanes distance2_from(const Core& core, const FaceLanes& face) {
  const Vec3Lanes from_a = face.middle - core.a, from_b = face.middle - core.b;
  const Lanes reach = face.radius + core.reach;
  if (!any(min(dot(from_a, from_a), dot(from_b, from_b)) < reach * reach)) return all(core.reach2);
  const FaceDistance a(face, core.a), b(face, core.b);
  return min(a.height2 + a.beside2, b.height2 + b.beside2);
}

/// Faces by their areas, for where points are straight over their inside.
struct FaceAreas {
  Vec3Lanes a, u, v, area;  // a corner, the sides to the next ones, m; their product, m2
  Lanes area2;

  PLEAT_KERNEL FaceAreas(const Vec3Lanes& corner, const Vec3Lanes& second, const Vec3Lanes& third)
      : a(corner), u(second - corner), v(third - corner), area(cross(u, v)), area2(dot(area, area)) {}

  /// Whether each of two points is, nearer than `reach`.
  struct Pair {
    LaneMask first, second;
  };
  PLEAT_KERNEL Pair have_below(const Vec3Lanes& p, const Vec3Lanes& q, float reach) const {
    const Vec3Lanes to_second = cross(v, area), to_third = cross(area, u);
    const Lanes most = area2 > 1e-16f ? reach * reach * area2 : all(-1.0f);
    return {has_below(p - a, to_second, to_third, most), has_below(q - a, to_second, to_third, most)};
  }

 private:
  PLEAT_KERNEL LaneMask has_below(const Vec3Lanes& w, const Vec3Lanes& to_second, const Vec3Lanes& to_third,
                                  const Lanes& most) const {
    const Lanes height = dot(w, area), second = dot(w, to_second), third = dot(w, to_third);
    return (height * height <= most) & (second > 0.0f) & (third > 0.0f) & (second + third < area2);
  }
};

/// The weights of the second and third corners at the foot of a point that is over a face.
struct FootWeights {
  Lanes second, third;

  PLEAT_KERNEL FootWeights(const FaceAreas& face, const Vec3Lanes& point) {
    const Vec3Lanes w = point - face.a;
    second = dot(cross(w, face.v), face.area) / face.area2, third = dot(cross(face.u, w), face.area) / face.area2;
  }
};

/// From the core to where triangles are nearest to it, m; as gap_to_triangle without taper, with the rounding of
/// EdgeDistance.
struct TriangleGap {
  Vec3Lanes away;
  Lanes distance2 = all(std::numeric_limits<float>::max());

  PLEAT_KERNEL TriangleGap(const Core& core, const Vec3Lanes& a, const Vec3Lanes& b, const Vec3Lanes& c) {
    for (const Vec3Lanes& corner : {a, b, c}) consider(away_from(core, corner));
    for (const EdgeLanes& side : {EdgeLanes(a, b), EdgeLanes(b, c), EdgeLanes(c, a)}) {
      consider(EdgeDistance(core, side).away);
    }
    const FaceAreas face(a, b, c);
    for (const Vec3Lanes& end : {core.a, core.b}) {
      const Vec3Lanes w = end - a;
      const Lanes wb = dot(cross(w, face.v), face.area), wc = dot(cross(face.u, w), face.area);
      const LaneMask over = (wb > 0.0f) & (wc > 0.0f) & (wb + wc < face.area2);
      consider(face.area * (-dot(w, face.area) / (over ? face.area2 : all(1.0f))), over);
    }
  }

 private:
  PLEAT_KERNEL void consider(const Vec3Lanes& found, const LaneMask& valid = LaneMask{} - 1) {
    const Lanes found2 = dot(found, found);
    const LaneMask nearer = valid & (found2 < distance2);
    away = choose(nearer, found, away), distance2 = nearer ? found2 : distance2;
  }
};

}  // namespace pleat
