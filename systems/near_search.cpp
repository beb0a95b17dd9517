#include "systems/near_search.h"

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

void add(const NearSearch& in, NearPair pair, float rest_distance, Stats& stats) {
  if (*in.pairs.count == in.pairs.capacity) {
    ++stats.contacts_dropped;
    return;
  }
  pair.distance = in.itself ? std::min(in.distance, kRestShare * rest_distance) : in.distance;
  const auto of_the_same = [&](const NearPair* p) {
    return p != in.memory->end && p->cloth == pair.cloth && p->kind == pair.kind && p->second == pair.second;
  };
  const NearPair* before = in.memory->next;
  while (of_the_same(before) && before->first != pair.first) ++before;
  if (of_the_same(before)) pair.side = before->side;
  in.pairs.pairs[(*in.pairs.count)++] = pair;
}

/// Brings the memory to the pairs of this cloth with this second feature.
void remember(const NearSearch& in, NearKind kind, std::uint32_t second) {
  const auto earlier = [&](const NearPair& p) {
    return std::tie(p.cloth, p.kind, p.second) < std::tie(in.cloth, kind, second);
  };
  while (in.memory->next != in.memory->end && earlier(*in.memory->next)) ++in.memory->next;
}

/// The space over and under a face.
struct Prism {
  std::uint32_t corner[3];
  Vec3 x[3], normal, outward[3];
  Box box;

  Prism(const PosedCloth& cloth, std::uint32_t face) {
    for (int k = 0; k < 3; ++k) {
      corner[k] = cloth.garment->face_particle[k][face];
      x[k] = cloth.position[corner[k]];
      box.include(x[k]);
    }
    normal = normalized_or(cross(x[1] - x[0], x[2] - x[0]), Vec3{});
    for (int k = 0; k < 3; ++k) outward[k] = normalized_or(cross(x[(k + 1) % 3] - x[k], normal), Vec3{});
  }
  bool has_corner(std::uint32_t particle) const {
    return particle == corner[0] || particle == corner[1] || particle == corner[2];
  }
  bool holds(const Vec3& p, float high, float wide) const {
    return std::abs(dot(p - x[0], normal)) <= high && dot(p - x[0], outward[0]) <= wide &&
           dot(p - x[1], outward[1]) <= wide && dot(p - x[2], outward[2]) <= wide;
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
  float half_length() const { return 0.5f * length(x[1] - x[0]); }
};

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

float near_margin(const Garment& first, const Garment& second) { return kMarginShare * mean_edge(first, second); }

Vec3 mean_motion(ConstVec3View from, ConstVec3View to, std::uint32_t count) {
  Vec3 sum;
  for (std::uint32_t i = 0; i < count; ++i) sum += to[i] - from[i];
  return sum * (1.0f / static_cast<float>(count));
}

float largest_motion(const Vec3& mean, ConstVec3View from, ConstVec3View to, std::uint32_t count, float part) {
  float most2 = 0.0f;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 d = (to[i] - from[i]) * part - mean;
    most2 = std::max(most2, dot(d, d));
  }
  return std::sqrt(most2);
}

float file_middles(const PosedCloth& cloth, NearScratch& scratch) {
  const Vec3View middles = scratch.middle.view();
  float longest = 0.0f;  // half of it
  for (std::uint32_t e = 0; e < cloth.garment->edge_count; ++e) {
    const Edge edge(cloth, e);
    middles.set(e, edge.middle());
    longest = std::max(longest, edge.half_length());
  }
  return longest;
}

std::size_t NearSearch::most_points(const Garment& garment) {
  return std::max(garment.particle_count, garment.edge_count);
}

void NearSearch::find_particle_face(NearKind kind, Stats& stats) const {
  const Garment& g = *second.garment;
  const float wide = kOverlapShare * mean_edge(*first.garment, g) + near_margin(*first.garment, g);
  const float around = std::max(reach, wide);
  const PointGrid grid(first.position, first.garment->particle_count, g.mean_edge_length + around, scratch->grid);
  for (std::uint32_t f = 0; f < g.face_count; ++f) {
    const Prism prism(second, f);
    remember(*this, kind, f);
    grid.for_each_near(prism.box.grown(around), [&](std::uint32_t p, const Vec3& x) {
      if ((itself && prism.has_corner(p)) || !prism.holds(x, reach, wide)) return;
      add(*this, {kind, p, f, cloth, 0.0f, 0.0f}, itself ? rest_distance_to_face(g, p, f) : 0.0f, stats);
    });
  }
}

void NearSearch::find_edges(Stats& stats) const {
  const float longest = file_middles(first, *scratch);  // half of it
  const PointGrid grid(scratch->middle.view(), first.garment->edge_count, longest + reach, scratch->grid);
  for (std::uint32_t e = 0; e < second.garment->edge_count; ++e) {
    const Edge edge(second, e);
    remember(*this, NearKind::kEdges, e);
    const Vec3 middle = edge.middle();
    const float around = longest + reach + edge.half_length();
    grid.for_each_near(Box{middle, middle}.grown(around), [&](std::uint32_t o, const Vec3& x) {
      if (itself && o >= e) return;
      const Vec3 between = x - middle;
      if (dot(between, between) > around * around) return;
      const Edge other(first, o);
      if ((itself && other.shares_end(edge)) || distance_between(other.x, edge.x) > reach) return;
      add(*this, {NearKind::kEdges, o, e, cloth, 0.0f, 0.0f},
          itself ? rest_distance_between(*first.garment, other, edge) : 0.0f, stats);
    });
  }
}

}  // namespace pleat
