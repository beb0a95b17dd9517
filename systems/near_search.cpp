#include "systems/near_search.h"

#include <algorithm>
#include <tuple>

#include "systems/closest_points.h"
#include "systems/point_grid.h"

namespace pleat {
namespace {

constexpr float kMarginShare = 0.15f;  // of the mean edge length
constexpr float kOverlapShare = 0.1f;  // of the mean edge length: so far beside a face it is still touched
constexpr float kRestShare = 0.5f;     // of the distance at rest that a pair of one cloth may keep

float mean_edge(const Garment& first, const Garment& second) {
  return std::max(first.mean_edge_length, second.mean_edge_length);
}

/// rest_distance(): between the two, of one cloth.
template <class RestDistance>
void add(const NearSearch& in, NearPair pair, const RestDistance& rest_distance, Stats& stats) {
  if (*in.pairs.count == in.pairs.capacity) {
    ++stats.contacts_dropped;
    return;
  }
  const auto of_the_same = [&](const NearPair* p) {
    return p != in.memory->end && p->cloth == pair.cloth && p->kind == pair.kind && p->second == pair.second;
  };
  const NearPair* before = in.memory->next;
  while (of_the_same(before) && before->first != pair.first) ++before;
  if (of_the_same(before)) {
    pair.side = before->side, pair.distance = before->distance;
  } else {
    pair.distance = in.itself ? std::min(in.distance, kRestShare * rest_distance()) : in.distance;
  }
  in.pairs.pairs[(*in.pairs.count)++] = pair;
}

/// Brings the memory to the pairs of this cloth with this second feature.
void remember(const NearSearch& in, NearKind kind, std::uint32_t second) {
  const auto earlier = [&](const NearPair& p) {
    return std::tie(p.cloth, p.kind, p.second) < std::tie(in.cloth, kind, second);
  };
  while (in.memory->next != in.memory->end && earlier(*in.memory->next)) ++in.memory->next;
}

struct Face {
  std::uint32_t corner[3];
  Vec3 x[3];

  Face(const PosedCloth& cloth, std::uint32_t face) {
    for (int k = 0; k < 3; ++k) {
      corner[k] = cloth.garment->face_particle[k][face];
      x[k] = cloth.position[corner[k]];
    }
  }
  bool has_corner(std::uint32_t particle) const {
    return particle == corner[0] || particle == corner[1] || particle == corner[2];
  }
  Box box() const {
    Box box;
    for (const Vec3& corner_at : x) box.include(corner_at);
    return box;
  }
};

/// The space over and under a face.
struct Prism {
  const Face& face;
  Vec3 normal, outward[3];

  explicit Prism(const Face& f) : face(f) {
    const Vec3(&x)[3] = face.x;
    normal = normalized_or(cross(x[1] - x[0], x[2] - x[0]), Vec3{});
    for (int k = 0; k < 3; ++k) outward[k] = normalized_or(cross(x[(k + 1) % 3] - x[k], normal), Vec3{});
  }
  PLEAT_KERNEL LaneMask holds(const Vec3Lanes& p, float high, float wide) const {
    LaneMask inside = abs(dot(p - all(face.x[0]), all(normal))) <= high;
    for (int k = 0; k < 3; ++k) inside &= dot(p - all(face.x[k]), all(outward[k])) <= wide;
    return inside;
  }
};

struct Edge {
  std::uint32_t end[2];
  Vec3 x[2];

  Edge(const PosedCloth& cloth, std::uint32_t edge) {
    for (int k = 0; k < 2; ++k) {
      end[k] = cloth.garment->edge_particle[k][edge];
      x[k] = cloth.position[end[k]];
    }
  }
  bool shares_end(const Edge& other) const {
    return end[0] == other.end[0] || end[0] == other.end[1] || end[1] == other.end[0] || end[1] == other.end[1];
  }
  Vec3 middle() const { return (x[0] + x[1]) * 0.5f; }
  /// From the middle to an end, and 1 / its length squared.
  Vec4 half() const {
    const Vec3 half = (x[1] - x[0]) * 0.5f;
    return {half.x, half.y, half.z, 1.0f / std::max(dot(half, half), 1e-30f)};
  }
  Box box() const {
    Box box;
    box.include(x[0]), box.include(x[1]);
    return box;
  }
};

/// Between an edge and eight others, each with its middle and half: squared, m2. As closest_between_segments does it,
/// but in single precision, where parallel ones may come out farther apart: by a thousandth of their lengths at most
/// where these are alike, by next to nothing where they are not nearly in touch.
PLEAT_KERNEL Lanes distance2_between(const Vec3Lanes& middle, const Vec4Lanes& half, const Vec3& other_middle,
                                     const Vec4& other_half) {
  const auto on_edge = [](const Lanes& t) PLEAT_KERNEL_LAMBDA { return min(max(t, all(-1.0f)), all(1.0f)); };
  const Vec3Lanes r = middle - all(other_middle), g = half.vector, h = all(vector_of(other_half));
  const Lanes a = dot(g, g), b = dot(g, h), c = dot(g, r), e = dot(h, h), f = dot(h, r);
  Lanes s = on_edge((b * f - c * e) / max(a * e - b * b, all(1e-30f)));
  const Lanes t = on_edge((b * s + f) * other_half.w);
  s = on_edge((b * t - c) * half.w);
  const Vec3Lanes apart = r + g * s - h * t;
  return dot(apart, apart);
}

float distance_between(const Vec3 (&p)[2], const Vec3 (&q)[2]) {
  const SegmentPair at = closest_between_segments(p[0], p[1], q[0], q[1]);
  return length(lerp(p[0], p[1], at.s) - lerp(q[0], q[1], at.t));
}

float rest_distance_to_face(const Garment& g, std::uint32_t particle, std::uint32_t face) {
  const ConstVec3View rest = g.rest_position.view();
  const Vec3 p = rest[particle], a = rest[g.face_particle[0][face]], b = rest[g.face_particle[1][face]],
             c = rest[g.face_particle[2][face]];
  return length(closest_on_triangle(p, a, b, c).point(a, b, c) - p);
}

float rest_distance_between(const Garment& g, const Edge& a, const Edge& b) {
  const ConstVec3View rest = g.rest_position.view();
  return distance_between({rest[a.end[0]], rest[a.end[1]]}, {rest[b.end[0]], rest[b.end[1]]});
}

}  // namespace

bool holds_all(const NearScratch& scratch, std::span<const LayerCloth> clothes) {
  return std::ranges::all_of(clothes, [&](const LayerCloth& cloth) {
    return cloth.garment == nullptr || scratch.holds(cloth.garment->particle_count, cloth.garment->edge_count);
  });
}

float near_margin(const Garment& first, const Garment& second) { return kMarginShare * mean_edge(first, second); }

Vec3 mean_motion(ConstVec3View from, ConstVec3View to, std::uint32_t count) {
  Vec3 sum;
  for (std::uint32_t i = 0; i < count; ++i) sum += to[i] - from[i];
  return sum * (1.0f / static_cast<float>(count));
}

float largest_motion(const Vec3& reference, ConstVec3View from, ConstVec3View to, std::uint32_t count, float part) {
  float most2 = 0.0f;
  run_wide(widest_vectors(), [&] {
    most2 = largest(count, [&](std::size_t i) {
      const Vec3Lanes d = (load(to, i) - load(from, i)) * all(part) - all(reference);
      return dot(d, d);
    });
  });
  return std::sqrt(most2);
}

float file_middles(const PosedCloth& cloth, NearScratch& scratch) {
  const Vec3View middles = scratch.middle.view();
  float longest = 0.0f;  // half of it
  for (std::uint32_t e = 0; e < cloth.garment->edge_count; ++e) {
    const Edge edge(cloth, e);
    middles.set(e, edge.middle());
    longest = std::max(longest, 0.5f * length(edge.x[1] - edge.x[0]));
  }
  return longest;
}

void NearSearch::find_particle_face(NearKind kind, Stats& stats) const {
  const Garment& g = *second.garment;
  const float wide = kOverlapShare * mean_edge(*first.garment, g) + near_margin(*first.garment, g);
  const float around = std::max(reach, wide);
  const PointGrid grid(first.position, first.garment->particle_count, g.mean_edge_length + around, scratch->grid);
  run_wide(widest_vectors(), [&] {
    for (std::uint32_t f = 0; f < g.face_count; ++f) {
      const Face face(second, f);
      const PointGrid::Places near = grid.near(face.box().grown(around));
      if (near.count == 0) continue;
      const Prism prism(face);
      remember(*this, kind, f);
      near.for_each_of(
          [&](const std::uint32_t* place)
              PLEAT_KERNEL_LAMBDA { return bits(prism.holds(gather(grid.points(), place).vector, reach, wide)); },
          [&](std::uint32_t place) {
            const std::uint32_t p = grid.filed(place);
            if (itself && face.has_corner(p)) return;
            add(
                *this, {kind, p, f, cloth, 0.0f, 0.0f}, [&] { return rest_distance_to_face(g, p, f); }, stats);
          });
    }
  });
}

void NearSearch::find_edges(Stats& stats) const {
  const float longest = file_middles(first, *scratch);  // half of it
  const PointGrid grid(scratch->middle.view(), first.garment->edge_count, longest + reach, scratch->grid);
  for (std::uint32_t place = 0; place < first.garment->edge_count; ++place) {
    scratch->half[place] = Edge(first, grid.filed(place)).half();
  }
  run_wide(widest_vectors(), [&] {
    for (std::uint32_t e = 0; e < second.garment->edge_count; ++e) {
      const Edge edge(second, e);
      const PointGrid::Places near = grid.near(edge.box().grown(longest + reach), itself ? e : kNone);
      if (near.count == 0) continue;
      const Vec3 middle = edge.middle();
      const Vec4 half = edge.half();
      remember(*this, NearKind::kEdges, e);
      near.for_each_of(
          [&](const std::uint32_t* place) PLEAT_KERNEL_LAMBDA {
            const Vec3Lanes middles = gather(grid.points(), place).vector;
            const Vec4Lanes halves = gather(scratch->half.data(), place);
            return bits(distance2_between(middles, halves, middle, half) <= reach * reach);
          },
          [&](std::uint32_t place) {
            const std::uint32_t o = grid.filed(place);
            const Edge other(first, o);
            if (itself && other.shares_end(edge)) return;
            add(
                *this, {NearKind::kEdges, o, e, cloth, 0.0f, 0.0f},
                [&] { return rest_distance_between(*first.garment, other, edge); }, stats);
          });
    }
  });
}

}  // namespace pleat
