// What of a cloth may touch what of the mesh bodies before the tick is over: looked up once, measured in each substep.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "components/column.h"
#include "components/lanes.h"
#include "components/vec4.h"

namespace pleat {

struct Garment;

/// Corner `corner` % 3 of the cloth's face `corner` / 3, and a triangle of a body.
struct MeshParticlePair {
  std::uint32_t corner, triangle;
};
/// A face of the cloth and a vertex of a body.
struct MeshVertexPair {
  std::uint32_t face, vertex;
};
/// An edge between two triangles of a body: its ends, and the third corners of the triangle that goes from the first to
/// the second one and of the other.
struct Ridge {
  std::uint32_t vertex[4];
};
/// An edge of the cloth, by its ends, and one of a body.
struct MeshEdgePair {
  std::uint32_t particle[2];
  Ridge ridge;
};

/// As many as there is room for.
template <class T>
struct BoundedList {
  Column<T> room;
  std::uint32_t count = 0;

  explicit BoundedList(std::pmr::memory_resource* m) : room(m) {}
  /// False where there is no room.
  bool add(const T& item) {
    if (count == room.size()) return false;
    room.data()[count++] = item;
    return true;
  }
  std::span<const T> between(std::uint32_t begin, std::uint32_t end) const {
    return {room.data() + begin, std::size_t{end - begin}};
  }
};

/// Eight triangles of a body as they move, their corners m, and the boxes around all corners.
struct MeshBlock {
  std::uint32_t triangle[kLanes];
  std::uint32_t opposite[3][kLanes];  // of edge k, where that counts here: the other triangle's third corner
  std::uint8_t corners[3], edges[3];  // a bit for each triangle whose corner k, or edge k with a neighbour, counts here
  std::uint8_t near, told;            // a bit for each that is near some face; for which that is filled in
  Vec3Lanes now[3], then[3];          // at the end of the substep and of the tick
  Vec3Lanes now_low, now_high, then_low, then_high;
};
/// Which of them come near a face: a bit for each, near corner c; vertex k; edge k near edge c.
struct MeshHits {
  std::uint32_t block;
  std::uint8_t particle[3], vertex[3], edges[3][3];
};

/// What of a body tells how far around it is looked.
struct MeshSought {
  bool met = false;
  float thickness = 0.0f, depth = 0.0f;  // m

  friend bool operator==(const MeshSought&, const MeshSought&) = default;
};

/// Where in the lists what belongs to one body ends, and what belongs to the next one begins.
struct MeshCandidateEnds {
  std::uint32_t particles = 0, vertices = 0, edges = 0, posed = 0;

  friend bool operator==(const MeshCandidateEnds&, const MeshCandidateEnds&) = default;
};

/// The candidates of one cloth, by bodies, then by faces in the order of their clusters, and how far they can be relied
/// on: while each particle i is within slack_i of anchor_i + drift_i (t - t_anchor), t being the fraction of the tick.
struct MeshCandidateColumns {
  BoundedList<MeshParticlePair> particles;
  BoundedList<MeshVertexPair> vertices;
  BoundedList<MeshEdgePair> edges;
  BoundedList<std::uint32_t> posed;  // the bodies' vertices that pairs name, each once a body
  Column<MeshCandidateEnds> ends;    // of each body
  bool complete = false;             // false: there was no room for all, they are of no use
  Column<MeshSought> sought;         // each body, as it was
  const Garment* garment = nullptr;  // whose they are
  Vec3 origin{};                     // of positions, m in the world
  std::uint64_t revision = 0;        // CollisionBodies::revision()
  Vec3Column anchor;                 // (P) m
  Vec3Column drift;                  // (P) m a tick
  Column<float> slack;               // (P) m
  float t_anchor = 0.0f;
  bool outlast_tick = false;  // bodies stand, nothing drifts, and particles that start deep were looked for
  float reach = 0.0f;         // m, up to which features are wanted of a body that keeps nothing besides

  // Scratch.
  Column<std::uint8_t> is_posed;  // (vertices of the largest body) 1 while a body's are being listed
  Column<Vec4> pose;              // (the same) m, where those listed of the body at hand are in a substep
  Column<float> distance2;        // m2, of pairs with particles
  Column<std::uint8_t> near;      // a bit for each other pair
  BoundedList<MeshBlock> blocks;  // of triangles near a cluster
  Column<MeshHits> hits;          // of these, on a face

  explicit MeshCandidateColumns(std::pmr::memory_resource* m)
      : particles(m),
        vertices(m),
        edges(m),
        posed(m),
        ends(m),
        sought(m),
        anchor(m),
        drift(m),
        slack(m),
        is_posed(m),
        pose(m),
        distance2(m),
        near(m),
        blocks(m),
        hits(m) {}

  /// For so many pairs of edges, and a share of that of others. Forgets what was found: another garment may come to be
  /// where this one was.
  void make_room(std::size_t cloth_particles, std::size_t bodies, std::size_t body_vertices, std::size_t body_triangles,
                 std::size_t pairs) {
    at_least(particles.room, pairs / 2), at_least(vertices.room, pairs / 4), at_least(edges.room, pairs);
    garment = nullptr;
    at_least(posed.room, pairs / 4), at_least(ends, bodies), at_least(sought, bodies);
    const std::size_t most_blocks = std::min((body_triangles + kLanes - 1) / kLanes, kMostBlocks);
    at_least(blocks.room, most_blocks), at_least(hits, most_blocks);
    at_least(anchor, cloth_particles), at_least(drift, cloth_particles), at_least(slack, cloth_particles);
    at_least(is_posed, body_vertices), at_least(pose, body_vertices);
    at_least(distance2, pairs / 2), at_least(near, pairs / 8 + 1);
  }
  static constexpr std::size_t kMostBlocks = 1024;
  MeshCandidateEnds so_far() const { return {particles.count, vertices.count, edges.count, posed.count}; }
};

}  // namespace pleat
