#include "systems/mesh_detection.h"

#include <array>
#include <utility>

#include "systems/contact_row.h"
#include "systems/mesh_pose.h"

namespace pleat {
namespace {

// Slopes. The sweeps turn what rows were made for; ridges and vertices of the body that are next to be met then have
// theirs already, else cloth that lies on two of them falls to one and the other by turns. A face beside a pin turns by
// 0.1 in a substep, an edge beside one by more. Rows of an edge are made by less where the next ridge is nearer than
// the edge is long, since less is missed there.
constexpr float kTurn = 0.2f;
constexpr float kTouching = 1e-4f;       // m; nearer than this the body's own normal is better than the difference
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

/// One mesh against one cloth, face by face.
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

  /// All triangles near the face.
  void test_face(std::uint32_t face, std::size_t mesh) const {
    Box box;
    for (const auto& particle : in.garment->face_particle) box.include(in.position[particle[face]]);
    box = box.grown(search);
    if (!box.moved(in.origin).overlaps(in.bodies->swept_box(mesh))) return;
    Face f = measure(face);
    const std::uint32_t own = features_of_face(*in.garment, in.inverse_mass, face);
    in.bodies->for_each_triangle(mesh, box.moved(in.origin),
                                 [&](std::uint32_t t) { meet(f, t, own & features_of_body(pose.topology, t)); });
    add_rows(f);
  }

  /// The candidates of one face.
  void test_candidates(const MeshCandidate* begin, const MeshCandidate* end) const {
    Face f = measure(begin->face);
    for (const MeshCandidate* pair = begin; pair != end; ++pair) meet(f, pair->triangle, pair->features);
    add_rows(f);
  }

 private:
  struct Face {
    std::uint32_t index = 0;
    std::uint32_t particle[3] = {};
    Vec3 x[3];
    Vec3 area, normal;
    Box around;  // what may matter
    float area2 = 0.0f;
    std::array<Nearest, 3> nearest;
    std::array<Standing, kRowsPerFace> standing;
    std::size_t standing_count = 0;
  };

  Face measure(std::uint32_t face) const {
    Face f;
    f.index = face;
    for (std::size_t c = 0; c < 3; ++c) {
      f.particle[c] = in.garment->face_particle[c][face];
      f.x[c] = in.position[f.particle[c]];
      f.nearest[c].distance2 = search * search;
      f.around.include(f.x[c]);
    }
    f.around = f.around.grown(search);
    const Vec3 u = f.x[1] - f.x[0], v = f.x[2] - f.x[0];
    f.area = cross(u, v);
    f.area2 = dot(f.area, f.area);
    f.normal = normalized_or(f.area, Vec3{});
    return f;
  }

  void add_rows(const Face& f) const {
    for (std::size_t c = 0; c < 3; ++c) add_particle_row(f, c);
    for (std::size_t k = 0; k < f.standing_count; ++k) add_face_row(f, f.standing[k]);
  }

  /// Measures what of the features lies within reach.
  void meet(Face& f, std::uint32_t t, std::uint32_t features) const {
    const MeshPose::Corners body = pose.corners(t);
    if (!f.around.overlaps(body.box())) return;
    const float a = dot(body.a - f.x[0], f.normal), b = dot(body.b - f.x[0], f.normal),
                c = dot(body.c - f.x[0], f.normal);
    const float height = std::max(std::min(std::min(a, b), c), -std::max(std::max(a, b), c));
    if (height > search) return;
    if (height > reach) features &= MeshCandidate::kParticles;
    for (; features != 0; features &= features - 1) {
      const MeshCandidate::Feature feature = MeshCandidate::first(features);
      switch (feature.kind) {
        case MeshCandidate::Kind::kParticle:
          find_nearest(f.x[feature.of_face], t, body, f.nearest[feature.of_face]);
          break;
        case MeshCandidate::Kind::kVertex:
          test_vertex(f, pose.corner(t, feature.of_body), body[feature.of_body]);
          break;
        case MeshCandidate::Kind::kEdges:
          test_edges(f, feature.of_face, t, body, feature.of_body);
          break;
      }
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
    const Vec3 w = q - f.x[0];
    const float height = -dot(w, f.normal);
    if (!(f.area2 > 1e-16f) || std::abs(height) > reach) return;
    const Vec3 u = f.x[1] - f.x[0], v = f.x[2] - f.x[0];
    const float b1 = dot(cross(w, v), f.area) / f.area2, b2 = dot(cross(u, w), f.area) / f.area2;
    if (!(b1 > 0.0f && b2 > 0.0f && b1 + b2 < 1.0f)) {
      for (std::size_t i = 0; i < 3; ++i) test_fold(f, i, vertex, q);
      return;
    }
    const float side = dot(pose.vertex_normal(vertex), f.normal) < 0.0f ? -1.0f : 1.0f;
    const Standing found{side * height, vertex, {1.0f - b1 - b2, b1, b2}, f.normal * side};
    const bool full = f.standing_count == kRowsPerFace;
    Standing* highest = std::max_element(f.standing.data(), f.standing.data() + f.standing_count,
                                         [](const Standing& a, const Standing& b) { return a.height < b.height; });
    if (full && highest->height <= found.height) return;
    if (!pose.is_extreme(vertex, found.normal, kTurn)) return;
    (full ? *highest : f.standing[f.standing_count++]) = found;
  }

  /// A vertex q of the body over neither face at edge i: cloth that is folded around it would come close there unseen.
  void test_fold(const Face& f, std::size_t i, std::uint32_t vertex, const Vec3& q) const {
    const Garment& g = *in.garment;
    const std::uint32_t edge = g.face_edge[i][f.index], across = g.edge_face[1][edge];
    if (g.edge_face[0][edge] != f.index || across == kNone) return;
    const std::size_t j = (i + 1) % 3;
    const Vec3 along = f.x[j] - f.x[i], w = q - f.x[i];
    const float length2 = dot(along, along), reached = dot(w, along);
    if (!(reached > 0.0f && reached < length2)) return;
    const float s = reached / length2;
    const Vec3 away = along * s - w;
    const float distance2 = dot(away, away);
    if (distance2 >= reach * reach || distance2 < kTouching * kTouching) return;
    std::uint32_t opposite = g.face_particle[0][across];
    for (std::size_t c = 1; opposite == f.particle[i] || opposite == f.particle[j]; ++c) {
      opposite = g.face_particle[c][across];
    }
    if (dot(away, f.x[(i + 2) % 3] - f.x[i]) < 0.0f || dot(away, in.position[opposite] - f.x[i]) < 0.0f) return;
    const float side = dot(pose.vertex_normal(vertex), away) < 0.0f ? -1.0f : 1.0f;
    const Vec3 normal = away * (side / std::sqrt(distance2));
    if (!pose.is_extreme(vertex, normal, kTurn)) return;
    rows.add({f.particle[i], f.particle[j], f.particle[j]}, {1.0f - s, s, 0.0f}, normal, q, thickness,
             pose.step(vertex), friction, 2, stats);
  }

  void add_face_row(const Face& f, const Standing& s) const {
    rows.add(f.particle, s.weight, s.normal, pose.vertex(s.vertex), thickness, pose.step(s.vertex), friction, 3, stats);
  }

  /// Edge i of the face against edge k of triangle t. They matter where, seen along their common normal, they cross;
  /// elsewhere an end of one is nearer and has a test of its own.
  void test_edges(const Face& f, std::size_t i, std::uint32_t t, const MeshPose::Corners& body, int k) const {
    const std::size_t j = (i + 1) % 3;
    const Vec3 a = body[k], b = body[(k + 1) % 3], along = b - a;
    const Vec3 edge = f.x[j] - f.x[i], between = a - f.x[i];
    // Most pairs do not cross. Dot products tell so for half the price, if with less certainty: what is near is left.
    const float ee = dot(edge, edge), aa = dot(along, along), ea = dot(edge, along), be = dot(between, edge),
                ba = dot(between, along), all = ee * aa, doubt = 1e-3f * all, most = all - ea * ea + doubt;
    const float s_all = be * aa - ba * ea, r_all = be * ea - ba * ee;
    if (s_all < -doubt || s_all > most || r_all < -doubt || r_all > most) return;
    const Vec3 common = cross(edge, along);
    const float common2 = dot(common, common), gap = dot(between, common);
    if (gap * gap >= reach * reach * common2) return;
    const float s = dot(cross(between, along), common), r = dot(cross(between, edge), common);
    if (!(s > 0.0f && s < common2 && r > 0.0f && r < common2)) return;
    const std::uint32_t across = pose.topology.neighbour[3 * t + static_cast<std::uint32_t>(k)];
    if (across == kNoTriangle) return;  // over a border it cannot be told what is outside
    const MeshPose::Corners other = pose.corners(across);
    const Vec3 n1 = body.normal(), n2 = other.normal();
    // Of the ridge's two faces, the directions into them; a valley or a flat edge is never met first.
    const Vec3 into1 = cross(n1, along), into2 = cross(along, n2);
    if (dot(n1, into2) > -1e-3f * length(into2)) return;
    const float side = dot(common, n1 + n2) < 0.0f ? -1.0f : 1.0f;
    const Vec3 normal = common * (side / std::sqrt(common2));
    // The heights of the two triangles over the ridge are the distances to the next ones.
    const float far = std::sqrt(ee * aa);
    const auto beyond = [&](const MeshPose::Corners& triangle, const Vec3& into) {
      const float next = length(cross(triangle.b - triangle.a, triangle.c - triangle.a));
      return dot(normal, into) * far > kTurn * std::min(next, far) * length(into);
    };
    if (beyond(body, into1) || beyond(other, into2)) return;

    const SegmentPair at{s / common2, r / common2};
    const std::uint32_t va = pose.corner(t, k), vb = pose.corner(t, (k + 1) % 3);
    rows.add({f.particle[i], f.particle[j], f.particle[j]}, {1.0f - at.s, at.s, 0.0f}, normal, lerp(a, b, at.t),
             thickness, lerp(pose.step(va), pose.step(vb), at.t), friction, 2, stats);
  }
};

}  // namespace

bool MeshDetection::validate() const {
  return garment != nullptr && position.x != nullptr && previous.x != nullptr && inverse_mass != nullptr &&
         bodies != nullptr && (meshes != nullptr || bodies->mesh_count() == 0) && contacts.count != nullptr &&
         thickness >= 0.0f && friction >= 0.0f && dt > 0.0f && t0 >= 0.0f && t0 < t1 && t1 <= 1.0f;
}

void MeshDetection::run(Stats& stats) const {
  const float margin = contact_margin(position, previous, garment->particle_count);
  const Box cloth = box_of(position, garment->particle_count);
  const ContactRowMaker rows{previous, inverse_mass, friction, dt, contacts};
  const std::uint32_t first = *contacts.count;
  const bool among = candidates != nullptr && candidates->complete;
  const MeshCandidate* next = among ? candidates->pairs.data() : nullptr;
  const MeshCandidate* const end = among ? next + candidates->count : nullptr;
  for (std::uint32_t m = 0; m < bodies->mesh_count(); ++m) {
    if (among ? next == end || next->mesh != m : !meshes[m]->enabled) continue;
    const MeshTest test{*this, {*meshes[m], bodies->topology(m), t0, t1, origin}, rows, margin, stats};
    if (among) {
      for (const MeshCandidate* begin = next; next != end && next->mesh == m; begin = next) {
        while (next != end && next->face == begin->face && next->mesh == m) ++next;
        test.test_candidates(begin, next);
      }
    } else if (cloth.grown(test.search).moved(origin).overlaps(bodies->swept_box(m))) {
      for (std::uint32_t f = 0; f < garment->face_count; ++f) test.test_face(f, m);
    }
  }
  // A particle is pushed best by its own row; an edge's row first would overshoot at one end.
  std::partition(contacts.rows + first, contacts.rows + *contacts.count,
                 [](const ContactRow& row) { return row.at_particle(); });
}

}  // namespace pleat
