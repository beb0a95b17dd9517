#include "systems/mesh_clearance.h"

#include <algorithm>
#include <array>
#include <bit>

#include "components/wide.h"
#include "systems/mesh_pose.h"
#include "systems/triangle_pairs.h"

namespace pleat {
namespace {

constexpr float kFlatSlope = 0.02f;  // up to which the body around a closest point may rise above it
constexpr float kTouching = 1e-5f;   // m; nearer than this the body's own normal is better than the difference
constexpr std::uint64_t kFirstOfEach = 0x0101010101010101;  // bit of eight
constexpr std::size_t kPlanesPerTriangle = 8;               // of a drawn triangle against one body

/// A plane that a drawn triangle may need.
struct Found {
  ClearancePlane plane;
  float distance2;  // m2
  bool outside;
};
bool nearer(const Found& a, const Found& b) { return a.distance2 < b.distance2; }

PLEAT_KERNEL BoxLanes box_around(const Vec3Lanes (&x)[3]) {
  return {{min(min(x[0].x, x[1].x), x[2].x), min(min(x[0].y, x[1].y), x[2].y), min(min(x[0].z, x[1].z), x[2].z)},
          {max(max(x[0].x, x[1].x), x[2].x), max(max(x[0].y, x[1].y), x[2].y), max(max(x[0].z, x[1].z), x[2].z)}};
}

/// How far a drawn vertex is from its place on the coarse triangle, at most, as it counts for a body that is above or
/// below that: of what leads away from the body, only what is sideways can bring it closer.
template <class T>
struct BulgeT {
  T up{}, down{};  // m

  PLEAT_KERNEL T reach() const { return max(up, down); }
  PLEAT_KERNEL void include(const BulgeT& b) { up = max(b.up, up), down = max(b.down, down); }
  /// Of eight or one, for a body that is so far above and below.
  template <class Far>
  PLEAT_KERNEL auto towards(const Far& above, const Far& below) const {
    return above > 0.0f ? Far{} + up : below > 0.0f ? Far{} + down : Far{} + reach();
  }
};

/// Eight coarse faces, and how far their drawn vertices are from their places on them.
struct FaceGroup {
  static constexpr std::size_t kRoom = kMaxVerticesPerFace * kLanes;
  std::uint32_t begin;
  Vec3Lanes corner[3], normal;                                 // m; unit, or zero
  BulgeT<Lanes> bulge;                                         // of all the vertices of a face
  BoxLanes box;                                                // around where bodies count
  float x[kRoom], y[kRoom], z[kRoom], up[kRoom], down[kRoom];  // m, of each vertex: its place; as in Bulge

  PLEAT_KERNEL FaceGroup(const MeshClearance& in, std::uint32_t first, float kept) : begin(first) {
    const std::uint32_t* drawn = in.pattern->drawn_of_faces(begin);
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = gather(in.footprint, drawn + k * kLanes);
    normal = normalized_or(cross(corner[1] - corner[0], corner[2] - corner[0]), Vec3Lanes{});
    const ConstVec3View positions = in.drawn_position;
    for (std::uint32_t i = 0; i < in.pattern->vertices_per_face; ++i) {
      const Vec3Lanes place = gather(in.footprint, drawn + i * kLanes);
      const Vec3Lanes moved = gather(positions, drawn + i * kLanes) - place;
      const Lanes rise = dot(moved, normal), aside = length(moved - normal * rise);
      const BulgeT<Lanes> one{max(rise, Lanes{}) + aside, max(-rise, Lanes{}) + aside};
      store(place, {x, y, z}, i * kLanes), store(one.up, up + i * kLanes), store(one.down, down + i * kLanes);
      bulge.include(one);
    }
    box = box_around(corner).grown(kept + bulge.reach());
  }
  PLEAT_KERNEL static Vec3 of(const Vec3Lanes& v, std::size_t lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }
};

/// Eight drawn triangles of one face, on the coarse triangle.
struct Footprints {
  Vec3Lanes corner[3];  // m
  BulgeT<Lanes> bulge;
  BoxLanes box;    // around where bodies count
  LaneMask valid;  // what the last group leaves empty repeats the face's last triangle

  /// triangles: of the face's own numbers, from the first of the group on; count: of those there are.
  PLEAT_KERNEL Footprints(const FaceGroup& faces, std::size_t lane, const std::uint32_t* triangles, std::size_t count,
                          float kept)
      : valid(first_lanes(count)) {
    std::uint32_t own[3][kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::uint32_t* t = triangles + 3 * std::min(k, count - 1);
      for (std::size_t c = 0; c < 3; ++c) own[c][k] = t[c] * kLanes;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      corner[c] = gather({faces.x + lane, faces.y + lane, faces.z + lane}, own[c]);
      bulge.include({gather(faces.up + lane, own[c]), gather(faces.down + lane, own[c])});
    }
    box = box_around(corner).grown(kept + bulge.reach());
  }

  /// A bit for each from which some drawn vertex may be too near to triangle k of a body.
  PLEAT_KERNEL std::uint8_t meet(const NearTriangles& body, std::size_t k, float kept) const {
    const auto of = [k](const Vec3Lanes& v) PLEAT_KERNEL_LAMBDA { return all(FaceGroup::of(v, k)); };
    const LaneMask overlap = box.overlaps({of(body.low), of(body.high)}) & valid;
    if (!any(overlap)) return 0;
    const float above = body.above[k], below = body.below[k];
    const Lanes limit = kept + bulge.towards(above, below);
    Lanes least, most, past{};
    along(of(body.corner[0]), of(body.normal), least, most);
    const Lanes over = max(max(least, -most), Lanes{});
    for (std::size_t c = 0; c < 3; ++c) {
      Lanes beside;
      along(of(body.corner[c]), of(body.aside[c]), beside, most);
      past = max(beside, past);
    }
    // They are no nearer than how far they are from the body's plane and, along that, past one of its sides.
    return bits(overlap & (max(above, below) < limit) & (over * over + past * past < limit * limit));
  }

 private:
  PLEAT_KERNEL void along(const Vec3Lanes& from, const Vec3Lanes& axis, Lanes& least, Lanes& most) const {
    const Lanes a = dot(corner[0] - from, axis), b = dot(corner[1] - from, axis), c = dot(corner[2] - from, axis);
    least = min(min(a, b), c), most = max(max(a, b), c);
  }
};

/// Footprints and triangles of a body that may be near each other, four side by side.
struct Pairs {
  float footprint[3][3][4], body[3][3][4];  // m, of each corner x, y and z
  Vec3 normal[4];                           // of the body's, unit, or zero
  float limit[4];                           // m
  std::uint32_t vertex[4][3], index[4], count = 0;

  PLEAT_KERNEL void fill() {
    for (std::size_t k = count; k < 4; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < 3; ++i) footprint[c][i][k] = footprint[c][i][0], body[c][i][k] = body[c][i][0];
      }
    }
  }
  PLEAT_KERNEL static void put(const Vec3& x, float (&to)[3][4], std::size_t k) {
    to[0][k] = x.x, to[1][k] = x.y, to[2][k] = x.z;
  }
  PLEAT_KERNEL static Vec3Four lanes(const float (&x)[3][4]) {
    Vec3Four v;
    std::memcpy(&v.x, x[0], sizeof v.x), std::memcpy(&v.y, x[1], sizeof v.y), std::memcpy(&v.z, x[2], sizeof v.z);
    return v;
  }
};

/// One mesh against one cloth, eight faces at a time.
struct MeshTest {
  const MeshClearance& in;
  MeshPose pose;
  std::uint32_t mesh;
  float kept = in.clearance + pose.mesh.thickness;
  std::uint32_t posed_leaves = 0;
  Pairs pairs{};
  std::array<Found, kPlanesPerTriangle> found{};  // of the footprint at hand
  std::size_t planes = 0;
  std::uint32_t vertex[3]{};  // its drawn ones

  PLEAT_KERNEL void run() {
    for (std::uint32_t f = 0; f < in.garment->face_count; f += kLanes) look_at(f);
    if (pairs.count != 0) measure();
    keep_planes();
  }

 private:
  PLEAT_KERNEL void look_at(std::uint32_t first) {
    const FaceGroup faces(in, first, kept);
    const Box& body = in.bodies->swept_box(mesh);
    std::uint32_t near = bits(faces.box.moved(all(in.origin)).overlaps({all(body.low), all(body.high)}) &
                              first_lanes(in.garment->face_count - first));
    for (; near != 0; near &= near - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(near));
      const std::uint32_t leaves = find_near(faces, lane);
      if (leaves != 0) test_triangles(faces, lane, leaves);
    }
  }

  /// The body's triangles from which some drawn vertex of the face may be too near. How many leaves have some.
  PLEAT_KERNEL std::uint32_t find_near(const FaceGroup& faces, std::size_t lane) {
    const auto of = [lane](const Vec3Lanes& v) PLEAT_KERNEL_LAMBDA { return FaceGroup::of(v, lane); };
    const Vec3Lanes normal = all(of(faces.normal)), corner = all(of(faces.corner[0])),
                    in_world = all(of(faces.corner[0]) + in.origin);
    const Vec3 at = of(faces.corner[0]) + in.origin;
    const float rounding = box_rounding(at);
    const BoxLanes box{all(of(faces.box.low)), all(of(faces.box.high))};
    const BoxLanes around = box.moved(all(in.origin)).grown(all(rounding));
    const BulgeT<float> bulge{faces.bulge.up[lane], faces.bulge.down[lane]};
    const float far_above = kept + bulge.up + rounding, far_below = kept + bulge.down + rounding;
    const LaneMask up_x = normal.x > 0.0f, up_y = normal.y > 0.0f, up_z = normal.z > 0.0f;
    const auto is_near = [&](const BoxLanes& b) PLEAT_KERNEL_LAMBDA {
      const Vec3Lanes low = b.low - in_world, high = b.high - in_world;
      const Vec3Lanes under{up_x ? low.x : high.x, up_y ? low.y : high.y, up_z ? low.z : high.z};
      const Vec3Lanes over{up_x ? high.x : low.x, up_y ? high.y : low.y, up_z ? high.z : low.z};
      return b.overlaps(around) & (dot(under, normal) < far_above) & (dot(over, normal) > -far_below);
    };
    std::uint32_t leaves = 0;
    in.bodies->triangle_boxes(mesh).for_each(is_near, [&](std::uint32_t leaf, std::uint32_t some) PLEAT_KERNEL_LAMBDA {
      if (leaf >= in.near.capacity) return;
      const std::uint32_t place = posed(leaf);
      NearTriangles& body = in.near.posed[place];
      const Lanes a = dot(body.corner[0] - corner, normal), b = dot(body.corner[1] - corner, normal);
      const Lanes c = dot(body.corner[2] - corner, normal);
      body.above = max(min(min(a, b), c), Lanes{}), body.below = max(-max(max(a, b), c), Lanes{});
      const LaneMask close = max(body.above, body.below) < kept + bulge.towards(body.above, body.below);
      body.near = bits(close & box.overlaps({body.low, body.high})) & some;
      if (body.near != 0) in.near.of_face[leaves++] = place;
    });
    return leaves;
  }

  /// Where a leaf of the body is, which is posed when it is first asked for.
  PLEAT_KERNEL std::uint32_t posed(std::uint32_t leaf) {
    const std::uint32_t place = in.near.place[leaf];
    if (place < posed_leaves && in.near.posed[place].leaf == leaf) return place;
    NearTriangles& to = in.near.posed[posed_leaves];
    const std::uint32_t* items = in.bodies->triangle_boxes(mesh).items(leaf);
    for (int k = 0; k < 3; ++k) {
      std::uint32_t index[kLanes];
      for (std::size_t i = 0; i < kLanes; ++i) index[i] = pose.corner(items[i], k);
      to.corner[k] = pose.vertices(index);
    }
    const Vec3Lanes(&x)[3] = to.corner;
    const BoxLanes box = box_around(x);
    to.low = box.low, to.high = box.high;
    to.normal = normalized_or(cross(x[1] - x[0], x[2] - x[0]), Vec3Lanes{});
    for (std::size_t k = 0; k < 3; ++k) {
      to.aside[k] = normalized_or(cross(x[(k + 1) % 3] - x[k], to.normal), Vec3Lanes{});
    }
    to.leaf = leaf;
    return in.near.place[leaf] = posed_leaves++;
  }

  PLEAT_KERNEL void test_triangles(const FaceGroup& faces, std::size_t lane, std::uint32_t leaves) {
    const std::uint32_t* drawn =
        in.pattern->face_vertices.data() + std::size_t{faces.begin + lane} * in.pattern->vertices_per_face;
    const std::uint32_t* triangles = in.pattern->face_triangles.data();
    const std::size_t count = in.pattern->face_triangles.size() / 3;
    for (std::size_t first = 0; first < count; first += kLanes, triangles += 3 * kLanes) {
      const Footprints footprints(faces, lane, triangles, count - first, kept);
      std::uint32_t some = 0;
      for (std::uint32_t l = 0; l < leaves; ++l) {
        NearTriangles& body = in.near.posed[in.near.of_face[l]];
        body.meets = 0;
        for (std::uint32_t rest = body.near; rest != 0; rest &= rest - 1) {
          const auto k = static_cast<std::size_t>(std::countr_zero(rest));
          const std::uint32_t meeting = footprints.meet(body, k, kept);
          body.meets |= std::uint64_t{meeting} << (kLanes * k);
          some |= meeting;
        }
      }
      for (; some != 0; some &= some - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(some));
        const std::uint32_t* t = triangles + 3 * i;
        for (std::uint32_t l = 0; l < leaves; ++l) {
          const NearTriangles& body = in.near.posed[in.near.of_face[l]];
          for (std::uint64_t rest = body.meets >> i & kFirstOfEach; rest != 0; rest &= rest - 1) {
            const std::size_t k = static_cast<std::size_t>(std::countr_zero(rest)) / kLanes;
            add_pair(footprints, i, body, k, {drawn[t[0]], drawn[t[1]], drawn[t[2]]});
          }
        }
      }
    }
  }

  PLEAT_KERNEL void add_pair(const Footprints& footprints, std::size_t i, const NearTriangles& body, std::size_t k,
                             const std::array<std::uint32_t, 3>& drawn) {
    const BulgeT<float> bulge{footprints.bulge.up[i], footprints.bulge.down[i]};
    const std::uint32_t n = pairs.count;
    for (std::size_t c = 0; c < 3; ++c) {
      Pairs::put(FaceGroup::of(footprints.corner[c], i), pairs.footprint[c], n);
      Pairs::put(FaceGroup::of(body.corner[c], k), pairs.body[c], n);
      pairs.vertex[n][c] = drawn[c];
    }
    pairs.normal[n] = FaceGroup::of(body.normal, k);
    pairs.limit[n] = kept + bulge.towards(float{body.above[k]}, float{body.below[k]});
    pairs.index[n] = in.bodies->triangle_boxes(mesh).items(body.leaf)[k];
    if (++pairs.count == 4) measure();
  }

  PLEAT_KERNEL void measure_four() {
    pairs.fill();
    const Vec3Four footprint[] = {Pairs::lanes(pairs.footprint[0]), Pairs::lanes(pairs.footprint[1]),
                                  Pairs::lanes(pairs.footprint[2])};
    const Vec3Four body[] = {Pairs::lanes(pairs.body[0]), Pairs::lanes(pairs.body[1]), Pairs::lanes(pairs.body[2])};
    const TrianglePairs closest(footprint, body);
    const Vec3Four surface = closest.second.point(body), away = closest.first.point(footprint) - surface;
    const Four distance2 = dot(away, away);
    for (std::size_t k = 0; k < pairs.count; ++k) {
      if (distance2[k] >= pairs.limit[k] * pairs.limit[k]) continue;
      meet(k, closest.second[k], {surface.x[k], surface.y[k], surface.z[k]}, {away.x[k], away.y[k], away.z[k]},
           distance2[k]);
    }
    pairs.count = 0;
  }
  /// A kernel of its own: one copy of it, wherever it is called from.
  void measure() {
    run_wide(widest_vectors(), [this] { measure_four(); });
  }

  /// Finds the plane between a footprint and a triangle of the body, where one is needed.
  void meet(std::size_t k, const Barycentrics& at, const Vec3& surface, const Vec3& away, float distance2) {
    const bool touches = distance2 < kTouching * kTouching;
    const bool on_face = at.zeros() == 0;
    Vec3 outward = pairs.normal[k];
    const Vec3 direction = on_face ? outward : normalized_or(away, Vec3{});
    if (at.zeros() == 2) {
      const std::uint32_t v = pose.corner(pairs.index[k], at.corner());
      const MeshPose::Ring ring = pose.look_around(v, direction, kFlatSlope);
      if (!touches && !ring.stands_out(1.0f)) return;
      outward = ring.normal;
    } else if (!on_face) {
      const std::uint32_t across = pose.topology.neighbour[3 * pairs.index[k] + static_cast<std::uint32_t>(at.edge())];
      if (across != kNoTriangle) {
        const MeshPose::Corners next = pose.corners(across);
        if (!touches && rises(next, surface, direction)) return;
        outward += next.normal();
      }
    }
    const float side = dot(away, outward) < 0.0f ? -1.0f : 1.0f;
    const Vec3 normal = normalized_or(touches || on_face ? outward : away * side, Vec3{});
    if (normal == Vec3{}) return;
    if (side < 0.0f && distance2 > pose.mesh.depth * pose.mesh.depth) return;

    const std::uint32_t(&drawn)[3] = pairs.vertex[k];
    if (!std::equal(drawn, drawn + 3, vertex)) {
      keep_planes();
      std::copy(drawn, drawn + 3, vertex);
    }
    const Found next{{normal, dot(normal, surface) + kept, {drawn[0], drawn[1], drawn[2]}}, distance2, side > 0.0f};
    if (planes < found.size()) {
      found[planes++] = next;
    } else if (Found& farthest = *std::ranges::max_element(found, nearer); nearer(next, farthest)) {
      farthest = next;
    }
  }

  /// From inside, only the nearest way out is right; from outside, what faces away is a far side.
  void keep_planes() {
    const Found* const nearest = std::min_element(found.data(), found.data() + planes, nearer);
    for (const Found* p = found.data(); p != found.data() + planes; ++p) {
      if (p == nearest || (nearest->outside && p->outside)) in.planes.add(p->plane, in.drawn_position);
    }
    planes = 0;
  }

  /// A triangle around a point of the body comes closer than that, seen in the direction away from it.
  static bool rises(const MeshPose::Corners& around, const Vec3& surface, const Vec3& direction) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = around[k] - surface;
      if (dot(d, direction) > kFlatSlope * length(d)) return true;
    }
    return false;
  }
};

}  // namespace

bool MeshClearance::validate() const {
  return garment != nullptr && pattern != nullptr && footprint.x != nullptr && bodies != nullptr &&
         (meshes != nullptr || bodies->mesh_count() == 0) && t >= 0.0f && t <= 1.0f && clearance >= 0.0f &&
         near.validate() && planes.validate() && drawn_position.x != nullptr;
}

void MeshClearance::run() const {
  const Box cloth = box_of(drawn_position, pattern->vertex_count).with(box_of(footprint, pattern->vertex_count));
  for (std::uint32_t m = 0; m < bodies->mesh_count(); ++m) {
    MeshTest test{*this, {*meshes[m], bodies->topology(m), t, t, origin}, m};
    if (!meshes[m]->meets(collides_with) || !cloth.grown(test.kept).moved(origin).overlaps(bodies->swept_box(m)))
      continue;
    run_wide(widest_vectors(), [&] { test.run(); });
  }
}

}  // namespace pleat
