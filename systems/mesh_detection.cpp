#include "systems/mesh_detection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "systems/contact_row.h"
#include "systems/mesh_facing.h"
#include "systems/mesh_pairs.h"
#include "systems/mesh_pose.h"

namespace pleat {
namespace {

constexpr float kTouching = 1e-4f;       // m; nearer than this the body's own normal is better than the difference
constexpr std::size_t kCrossing = 256;   // pairs of edges that cross each other, asked together whether they are met
constexpr std::size_t kRowsPerFace = 4;  // the deepest body vertices over a face

/// What is nearest to one corner of the face at hand.
struct Nearest {
  float distance2 = 0.0f;  // m2; at first the square of how far to look
  std::uint32_t triangle = kNoTriangle;
  Barycentrics at{};
};

/// A body vertex over the face at hand.
struct Standing {
  float height;  // of the face over the vertex, negative when the vertex has come through, m
  std::uint32_t vertex;
  float weight[3];
  Vec3 normal;
};

/// One mesh against one cloth.
struct MeshTest {
  const MeshDetection& in;
  MeshPose pose;
  ContactRowMaker rows;
  float margin;
  Stats& stats;
  float friction = pose.mesh.friction;
  float thickness = in.thickness + pose.mesh.thickness;
  float reach = thickness + margin;
  float search = mesh_search(pose.mesh, reach, in.t0);

  /// Without candidates: the same rows in the same order, after asking the tree about each face three times.
  void test_all(std::size_t mesh) const {
    const Garment& g = *in.garment;
    const auto& topology = pose.topology;
    for (const std::uint32_t face : g.clustered_faces) {
      for_each_near(mesh, face, [&](std::span<const std::uint32_t> near) {
        for (int k = 0; k < 3; ++k) {
          for (std::size_t c = 0; c < 3; ++c) {
            if (!owns_edge(g, face, c)) continue;
            const std::uint32_t edge = g.face_edge[c][face];
            MeshEdgePair pair{{g.edge_particle[0][edge], g.edge_particle[1][edge]}, {}};
            for (const std::uint32_t t : near) {
              if (!topology.owns_edge(t, k) || !find_ridge(pose.mesh, topology, t, k, pair.ridge)) continue;
              test_edges(pair, [&](std::uint32_t v) { return pose.vertex(v); });
            }
          }
        }
      });
    }
    for (const std::uint32_t face : g.clustered_faces) {
      Face f = measure(face);
      for_each_near(mesh, face, [&](std::span<const std::uint32_t> near) {
        for (const std::uint32_t t : near) {
          for (std::size_t c = 0; c < 3; ++c) {
            if (owns_particle(g, in.inverse_mass, face, c)) find_nearest(f.x[c], t, pose.corners(t), f.nearest[c]);
          }
        }
      });
      add_rows(f);
    }
    for (const std::uint32_t face : g.clustered_faces) {
      Face f = measure(face);
      for_each_near(mesh, face, [&](std::span<const std::uint32_t> near) {
        for (int k = 0; k < 3; ++k) {
          for (const std::uint32_t t : near) {
            if (topology.owns_corner(t, k)) test_vertex(f, pose.corner(t, k), pose.vertex(pose.corner(t, k)));
          }
        }
      });
      add_rows(f);
    }
  }

  /// The candidates of this mesh, from `begin` to `end` in the lists. Of these the lanes find those that come near.
  void test_candidates(MeshCandidateColumns& all, const MeshCandidateEnds& begin, const MeshCandidateEnds& end) const {
    Vec4* const body = all.pose.data();
    for (const std::uint32_t v : all.posed.between(begin.posed, end.posed)) {
      const Vec3 at = pose.vertex(v);
      body[v] = {at.x, at.y, at.z, 0.0f};
    }
    const MeshPairs pairs{*in.garment, in.packed, body, pose.mesh.triangles.data(), reach};
    const auto edges = all.edges.between(begin.edges, end.edges);
    pairs.find_near(edges, all.near.data());
    std::array<MeshEdgePair, kCrossing> crossing;
    std::array<std::uint8_t, kCrossing / kLanes> met;
    std::size_t count = 0;
    const auto test_crossing = [&] {
      const std::span<const MeshEdgePair> some{crossing.data(), std::exchange(count, 0)};
      pairs.find_met(some, met.data());
      for_each_near(some, met.data(), [&](const MeshEdgePair& pair) {
        test_edges(pair, [&](std::uint32_t v) { return vector_of(body[v]); });
      });
    };
    for_each_near(edges, all.near.data(), [&](const MeshEdgePair& pair) {
      crossing[count++] = pair;
      if (count == crossing.size()) test_crossing();
    });
    test_crossing();

    const auto particles = all.particles.between(begin.particles, end.particles);
    pairs.measure(particles, all.distance2.data());
    for (auto first = particles.begin(); first != particles.end();) {
      Face f = measure(first->corner / 3);
      const auto last = std::find_if(first, particles.end(), [&](const auto& p) { return p.corner / 3 != f.index; });
      find_nearest(f, {first, last}, all.distance2.data() + (first - particles.begin()));
      add_rows(f);
      first = last;
    }
    const auto vertices = all.vertices.between(begin.vertices, end.vertices);
    pairs.find_near(vertices, all.near.data());
    Face f;
    for_each_near(vertices, all.near.data(), [&](const MeshVertexPair& pair) {
      if (f.index != pair.face) add_rows(std::exchange(f, measure(pair.face)));
      test_vertex(f, pair.vertex, vector_of(body[pair.vertex]));
    });
    add_rows(f);
  }

 private:
  struct Face {
    std::uint32_t index = kNone;
    std::uint32_t particle[3] = {};
    Vec3 x[3];
    Vec3 normal;
    std::array<Nearest, 3> nearest;
    std::array<Standing, kRowsPerFace> standing;
    std::size_t standing_count = 0;
  };

  /// test(triangles near the face), as many at a time as the lists of candidates hold at most of a face.
  template <class Test>
  void for_each_near(std::size_t mesh, std::uint32_t face, const Test& test) const {
    Box box;
    for (const auto& particle : in.garment->face_particle) box.include(in.position[particle[face]]);
    box = box.grown(search);
    std::array<std::uint32_t, kLanes * MeshCandidateColumns::kMostBlocks> near;
    std::size_t count = 0;
    in.bodies->for_each_triangle(mesh, box.moved(in.origin), [&](std::uint32_t t) {
      if (!box.overlaps(pose.corners(t).box())) return;
      near[count++] = t;
      if (count < near.size()) return;
      test(std::span<const std::uint32_t>(near));
      count = 0;
    });
    test(std::span<const std::uint32_t>(near.data(), count));
  }

  /// test(pair) for those of the pairs whose bit is set.
  template <class Pair, class Test>
  static void for_each_near(std::span<const Pair> pairs, const std::uint8_t* near, const Test& test) {
    for (std::size_t begin = 0; begin < pairs.size(); begin += kLanes) {
      for (std::uint32_t some = near[begin / kLanes]; some != 0; some &= some - 1) {
        test(pairs[begin + static_cast<std::size_t>(std::countr_zero(some))]);
      }
    }
  }

  Face measure(std::uint32_t face) const {
    Face f;
    f.index = face;
    for (std::size_t c = 0; c < 3; ++c) {
      f.particle[c] = in.garment->face_particle[c][face];
      f.x[c] = in.position[f.particle[c]];
      f.nearest[c].distance2 = search * search;
    }
    f.normal = normalized_or(cross(f.x[1] - f.x[0], f.x[2] - f.x[0]), Vec3{});
    return f;
  }

  void add_rows(const Face& f) const {
    for (std::size_t c = 0; c < 3; ++c) add_particle_row(f, c);
    for (std::size_t k = 0; k < f.standing_count; ++k) add_face_row(f, f.standing[k]);
  }

  /// Of one face's pairs with particles: only those that may be the nearest are measured well.
  void find_nearest(Face& f, std::span<const MeshParticlePair> pairs, const float* distance2) const {
    std::array<float, 3> limit2;
    limit2.fill(search * search);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      float& least2 = limit2[pairs[i].corner % 3];
      least2 = std::min(least2, distance2[i]);
    }
    for (float& least2 : limit2) {
      const float limit = std::sqrt(least2) + 2.0f * MeshPairs::kDistanceError;
      least2 = limit * limit;
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::size_t c = pairs[i].corner % 3;
      if (distance2[i] > limit2[c]) continue;
      find_nearest(f.x[c], pairs[i].triangle, pose.corners(pairs[i].triangle), f.nearest[c]);
    }
  }

  static void find_nearest(const Vec3& p, std::uint32_t t, const MeshPose::Corners& body, Nearest& nearest) {
    if (body.box().distance2(p) > nearest.distance2) return;
    const Barycentrics at = closest_on_triangle(p, body.a, body.b, body.c);
    const Vec3 d = p - at.point(body.a, body.b, body.c);
    if (dot(d, d) < nearest.distance2) nearest = {dot(d, d), t, at};
  }

  void add_particle_row(const Face& f, std::size_t c) const {
    const auto& [distance2, t, at] = f.nearest[c];
    if (t == kNoTriangle) return;
    const MeshPose::Corners body = pose.corners(t);
    const Vec3 surface = at.point(body.a, body.b, body.c), away = f.x[c] - surface;
    const auto [outward, on_face, border] = pose.outward(t, at);
    const bool inside = dot(away, outward) < 0.0f;
    if (inside ? border || distance2 > pose.mesh.depth * pose.mesh.depth : distance2 > reach * reach) return;
    const bool own_normal = on_face || distance2 < kTouching * kTouching;
    const Vec3 normal = normalized_or(own_normal ? outward : inside ? -away : away, Vec3{});
    if (normal == Vec3{}) return;
    const Vec3 step =
        at.point(pose.step(pose.corner(t, 0)), pose.step(pose.corner(t, 1)), pose.step(pose.corner(t, 2)));
    const std::uint32_t i = f.particle[c];
    rows.add({i, i, i}, {1.0f, 0.0f, 0.0f}, normal, surface, thickness, step, friction, 1, stats);
  }

  /// A vertex q of the body over the inside of the face. Where it stands out, its angle-weighted normal tells its side,
  /// for needles too; elsewhere the side does not matter.
  void test_vertex(Face& f, std::uint32_t vertex, const Vec3& q) const {
    const VertexOverFace<float> at(f.x, q);
    if (!at.over) {
      for (std::size_t i = 0; i < 3; ++i) test_fold(f, i, vertex, q);
      return;
    }
    if (!at.within(reach)) return;
    const MeshPose::Ring ring = pose.look_around(vertex, f.normal, kTurn);
    const float side = dot(ring.normal, f.normal) < 0.0f ? -1.0f : 1.0f;
    const Standing found{side * at.height, vertex, {1.0f - at.b1 - at.b2, at.b1, at.b2}, f.normal * side};
    const bool full = f.standing_count == kRowsPerFace;
    Standing* highest = std::max_element(f.standing.data(), f.standing.data() + f.standing_count,
                                         [](const Standing& a, const Standing& b) { return a.height < b.height; });
    if (ring.stands_out(side) && !(full && highest->height <= found.height)) {
      (full ? *highest : f.standing[f.standing_count++]) = found;
    }
  }

  /// A vertex q of the body over neither face at edge i: cloth that is folded around it would come close there unseen.
  void test_fold(const Face& f, std::size_t i, std::uint32_t vertex, const Vec3& q) const {
    const Garment& g = *in.garment;
    const std::uint32_t edge = g.face_edge[i][f.index], across = g.edge_face[1][edge];
    if (g.edge_face[0][edge] != f.index || across == kNone) return;
    const std::size_t j = (i + 1) % 3;
    const VertexAtEdge<float> at(f.x[i], f.x[j], q);
    if (!at.within(reach) || at.distance2 < kTouching * kTouching) return;
    std::uint32_t opposite = g.face_particle[0][across];
    for (std::size_t c = 1; opposite == f.particle[i] || opposite == f.particle[j]; ++c) {
      opposite = g.face_particle[c][across];
    }
    if (dot(at.away, f.x[(i + 2) % 3] - f.x[i]) < 0.0f || dot(at.away, in.position[opposite] - f.x[i]) < 0.0f) return;
    const Vec3 away = at.away * (1.0f / std::sqrt(at.distance2));
    const MeshPose::Ring ring = pose.look_around(vertex, away, kTurn);
    const float side = dot(ring.normal, away) < 0.0f ? -1.0f : 1.0f;
    if (!ring.stands_out(side)) return;
    const Vec3 normal = away * side;
    rows.add({f.particle[i], f.particle[j], f.particle[j]}, {1.0f - at.s, at.s, 0.0f}, normal, q, thickness,
             pose.step(vertex), friction, 2, stats);
  }

  void add_face_row(const Face& f, const Standing& s) const {
    rows.add(f.particle, s.weight, s.normal, pose.vertex(s.vertex), thickness, pose.step(s.vertex), friction, 3, stats);
  }

  /// An edge of the cloth against one of the body, whose vertex v is at place(v). They matter where, seen along their
  /// common normal, they cross; elsewhere an end of one is nearer and has a test of its own.
  template <class Place>
  void test_edges(const MeshEdgePair& pair, const Place& place) const {
    const auto [i, j] = pair.particle;
    const auto& v = pair.ridge.vertex;
    const Vec3 p[2] = {in.position[i], in.position[j]}, q[4] = {place(v[0]), place(v[1]), place(v[2]), place(v[3])};
    const EdgesFacing<float> at(p[0], p[1], q[0], q[1]);
    if (!at.within(reach)) return;
    const RidgeFacing<float> ridge(at, p[0], p[1], q);
    if (!ridge.met) return;
    const float s = at.s / at.common2, r = at.r / at.common2;
    rows.add({i, j, j}, {1.0f - s, s, 0.0f}, ridge.normal, lerp(q[0], q[1], r), thickness,
             lerp(pose.step(v[0]), pose.step(v[1]), r), friction, 2, stats);
  }
};

}  // namespace

bool MeshDetection::validate() const {
  return garment != nullptr && position.x != nullptr && packed != nullptr && previous.x != nullptr &&
         inverse_mass != nullptr && bodies != nullptr && (meshes != nullptr || bodies->mesh_count() == 0) &&
         contacts.count != nullptr && thickness >= 0.0f && friction >= 0.0f && dt > 0.0f && t0 >= 0.0f && t0 < t1 &&
         t1 <= 1.0f;
}

void MeshDetection::run(Stats& stats) const {
  const float margin = contact_margin(position, previous, garment->particle_count);
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  const std::uint32_t first = *contacts.count;
  const bool among = candidates != nullptr && candidates->complete;
  MeshCandidateEnds begin;
  for (std::uint32_t m = 0; m < bodies->mesh_count(); ++m) {
    const MeshCandidateEnds end = among ? candidates->ends[m] : begin;
    if (among ? end == begin : !meshes[m]->meets(collides_with)) continue;
    const MeshTest test{*this, {*meshes[m], bodies->topology(m), t0, t1, origin}, rows, margin, stats};
    if (among) {
      test.test_candidates(*candidates, std::exchange(begin, end), end);
    } else if (box_of(position, garment->particle_count)
                   .grown(test.search)
                   .moved(origin)
                   .overlaps(bodies->swept_box(m))) {
      test.test_all(m);
    }
  }
  // A particle is pushed best by its own row; an edge's row first would overshoot at one end.
  std::partition(contacts.rows + first, contacts.rows + *contacts.count,
                 [](const ContactRow& row) { return row.at_particle(); });
}

}  // namespace pleat
