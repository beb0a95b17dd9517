#include "systems/mesh_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "systems/closest_points.h"
#include "systems/mesh_pose.h"
#include "tests/systems/contact_scene.h"
#include "tests/systems/surface_fixture.h"

namespace pleat::test {
namespace {

constexpr float kClearance = 0.0025f;
constexpr float kRounding = 5e-6f;  // m

/// A convex body 5 mm under the sheet at y = 0, which is what contact keeps: `shape` turned about z and lowered.
MeshCollider under_sheet(BodyShape shape, float turn = 0.0f, float x = 0.0f, float gap = 0.005f) {
  float top = -1.0f;
  for (Vec3& p : shape.positions) {
    p = {p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn), p.z};
    top = std::max(top, p.y);
  }
  for (Vec3& p : shape.positions) p += {x, -top - gap, 0.0f};
  return make_body(shape.positions, shape.triangles);
}

/// A sheet of 1 m whose drawn surface sags by at most `sag` between the particles, over one body.
struct Sagging {
  Surface surface;
  MeshCollider mesh;
  const MeshCollider* pointer = &mesh;
  CollisionBodies bodies{memory()};
  Vec3Column footprint{memory()};
  NearTriangleColumns near{memory()};
  std::vector<ClearancePlane> planes = std::vector<ClearancePlane>(4096);
  std::uint32_t count = 0;

  Sagging(float sag, MeshCollider&& body, std::uint32_t level = 0) : surface(sheet(5), level), mesh(std::move(body)) {
    near.make_room(mesh.triangles.size() / 3);
    bodies.add_mesh(mesh);
    surface.run();
    footprint.resize(surface.pattern.vertex_count);
    Tessellation flat = surface.tessellation();
    flat.mode = SurfaceMode::kFlat;
    flat.drawn_position = footprint.view();
    flat.run();
    for (std::uint32_t v = surface.garment.particle_count; v < surface.pattern.vertex_count; ++v) {
      const Vec3 x = drawn(v);
      const float part = 0.6f + 0.4f * std::sin(40.0f * x.x) * std::cos(30.0f * x.z);
      surface.drawn.view().set(v, x - Vec3{0.0f, sag * part, 0.0f});
    }
  }
  Vec3 drawn(std::uint32_t v) const { return surface.drawn.view()[v]; }
  std::vector<Vec3> all_drawn() const {
    std::vector<Vec3> x;
    for (std::uint32_t v = 0; v < surface.pattern.vertex_count; ++v) x.push_back(drawn(v));
    return x;
  }
  MeshClearance system() {
    return {.garment = &surface.garment,
            .pattern = &surface.pattern,
            .footprint = footprint.view(),
            .bodies = &bodies,
            .meshes = &pointer,
            .clearance = kClearance,
            .near = near.view(),
            .planes = {planes.data(), static_cast<std::uint32_t>(planes.size()), &count},
            .drawn_position = surface.drawn.view()};
  }
  void run() {
    const MeshClearance s = system();
    ASSERT_TRUE(s.validate());
    s.run();
    s.planes.settle(surface.drawn.view());
  }

  /// The least distance of points all over the drawn triangles to the body, which is convex; negative inside. By
  /// sampling, independent of the system.
  float least_distance() const {
    constexpr int kSide = 6;
    float least = std::numeric_limits<float>::max();
    const auto& indices = surface.pattern.indices;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      const Vec3 p = drawn(indices[t]), q = drawn(indices[t + 1]), r = drawn(indices[t + 2]);
      for (int i = 0; i <= kSide; ++i) {
        for (int j = 0; i + j <= kSide; ++j) {
          const Vec3 x = p + (q - p) * (static_cast<float>(i) / kSide) + (r - p) * (static_cast<float>(j) / kSide);
          if (x.y < 0.02f) least = std::min(least, distance_of(x, least));
        }
      }
    }
    return least;
  }

 private:
  float distance_of(const Vec3& x, float bound) const {
    float outside = -std::numeric_limits<float>::max(), distance = std::numeric_limits<float>::max();
    const ConstVec3View at = mesh.next.view();
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const Vec3 a = at[mesh.triangles[t]], b = at[mesh.triangles[t + 1]], c = at[mesh.triangles[t + 2]];
      outside = std::max(outside, dot(x - a, normalized_or(cross(b - a, c - a), Vec3{})));
      if (outside > bound) return outside;
      distance = std::min(distance, length(closest_on_triangle(x, a, b, c).point(a, b, c) - x));
    }
    return outside > 0.0f ? distance : -distance;
  }
};

TEST(MeshClearance, DrawnTrianglesKeepTheClearanceFromASphereAtEveryLevelProperty) {
  for (const std::uint32_t level : {0u, 1u, 3u, 8u}) {
    Sagging s(0.03f, under_sheet(icosphere(2, 0.3f)), level);
    ASSERT_LT(s.least_distance(), -0.001f);
    s.run();
    EXPECT_GE(s.least_distance(), kClearance - kRounding) << "level " << level;
  }
}

TEST(MeshClearance, ASharpEdgeDoesNotCutBetweenDrawnVerticesProperty) {
  for (const float turn : {0.0f, 0.2f, 0.785f}) {
    for (const float x : {0.0f, 0.013f, 0.1f, 0.31f}) {
      Sagging s(0.03f, under_sheet(box_shape({0.2f, 0.2f, 0.33f}), turn, x));
      s.run();
      EXPECT_GE(s.least_distance(), kClearance - kRounding) << "turn " << turn << ", x " << x;
    }
  }
}

TEST(MeshClearance, AFlatBodyPushesStraightUpAcrossItsInnerEdges) {
  Sagging s(0.03f, under_sheet(box_shape({2.0f, 0.2f, 2.0f})));
  const std::vector<Vec3> before = s.all_drawn();
  s.run();
  for (std::uint32_t v = 0; v < before.size(); ++v) {
    EXPECT_NEAR(s.drawn(v).y, std::max(before[v].y, -0.005f + kClearance), kRounding);
    EXPECT_NEAR(s.drawn(v).x, before[v].x, kRounding);
    EXPECT_NEAR(s.drawn(v).z, before[v].z, kRounding);
  }
}

TEST(MeshClearance, WhatContactLeftInsideComesOutTheNearestWay) {
  for (const std::uint32_t detail : {2u, 4u}) {  // a few triangles under each drawn one, and dozens
    for (const float gap : {0.0f, -0.001f}) {
      Sagging s(0.01f, under_sheet(icosphere(static_cast<int>(detail), 0.3f), 0.0f, 0.0f, gap));
      const std::vector<Vec3> before = s.all_drawn();
      s.run();
      EXPECT_GE(s.least_distance(), kClearance - kRounding) << "detail " << detail << ", gap " << gap;
      for (std::uint32_t v = 0; v < before.size(); ++v) EXPECT_LT(length(s.drawn(v) - before[v]), 0.02f);
    }
  }
}

TEST(MeshClearance, WhatIsOutsideIsUntouchedBitForBitAndNoPlaneIsKept) {
  for (const float sag : {-0.05f, 0.002f}) {  // away from the body; less than the gap allows
    Sagging s(sag, under_sheet(icosphere(2, 0.3f)));
    const std::vector<Vec3> before = s.all_drawn();
    s.system().run();
    EXPECT_EQ(s.count, 0u);
    EXPECT_EQ(before, s.all_drawn());
  }
}

TEST(MeshClearance, ClothThatCameThroughIsDrawnOutside) {
  Sagging s(0.005f, under_sheet(box_shape({2.0f, 0.2f, 2.0f}), 0.0f, 0.0f, -0.002f));
  s.run();
  for (const Vec3& x : s.all_drawn()) EXPECT_NEAR(x.y, 0.002f + kClearance, kRounding);
}

TEST(MeshClearance, TheFarSideOfAThinBodyDoesNotPull) {
  Sagging s(0.03f, under_sheet(box_shape({2.0f, 0.001f, 2.0f})));
  s.run();
  for (const Vec3& x : s.all_drawn()) EXPECT_GE(x.y, -0.005f + kClearance - kRounding);
}

TEST(MeshClearance, MarginOfTheBodyIsKeptAndADisabledOneIsNotMet) {
  MeshCollider padded = under_sheet(icosphere(2, 0.3f));
  padded.thickness = 0.002f;
  Sagging s(0.03f, std::move(padded));
  s.run();
  EXPECT_GE(s.least_distance(), kClearance + 0.002f - kRounding);

  Sagging off(0.03f, under_sheet(icosphere(2, 0.3f)));
  off.mesh.enabled = false;
  const std::vector<Vec3> before = off.all_drawn();
  off.run();
  EXPECT_EQ(before, off.all_drawn());
}

TEST(MeshClearance, ContinuousInTheMotionOfTheBodyProperty) {
  constexpr float kStep = 2e-4f;
  std::vector<Vec3> last;
  float largest = 0.0f;
  for (int i = 0; i <= 400; ++i) {  // rises until contact would hold it, then slides along, edges and corners first
    const float shift = kStep * static_cast<float>(i), rise = std::min(shift - 0.04f, 0.0f);
    Sagging s(0.03f, under_sheet(box_shape({0.2f, 0.2f, 0.33f}), 0.3f, std::max(shift - 0.04f, 0.0f), 0.005f - rise));
    s.run();
    const std::vector<Vec3> now = s.all_drawn();
    for (std::size_t v = 0; v < last.size(); ++v) largest = std::max(largest, length(now[v] - last[v]));
    last = now;
  }
  EXPECT_GT(largest, 0.0f);
  EXPECT_LT(largest, 20.0f * kStep);  // a pop would be a centimetre
}

TEST(MeshClearance, AListTooSmallIsSettledInTurn) {
  Sagging s(0.03f, under_sheet(icosphere(2, 0.3f)));
  s.planes.resize(7);
  s.run();
  EXPECT_GE(s.least_distance(), kClearance - kRounding);
}

/// The planes that are needed, triangle by triangle and pair by pair. Independent of how the system finds them.
std::vector<std::vector<ClearancePlane>> plain_planes(const Sagging& s) {
  const TessellationPattern& pattern = s.surface.pattern;
  const MeshPose pose{s.mesh, s.bodies.topology(0), 1.0f, 1.0f};
  const float kept = kClearance + s.mesh.thickness;
  const ConstVec3View at = s.footprint.view();
  std::vector<std::vector<ClearancePlane>> planes;
  for (std::uint32_t f = 0; f < s.surface.garment.face_count; ++f) {
    const std::uint32_t* of_face = pattern.face_vertices.data() + std::size_t{f} * pattern.vertices_per_face;
    const Vec3 face = at[of_face[0]];
    const Vec3 up = normalized_or(cross(at[of_face[1]] - face, at[of_face[2]] - face), Vec3{});
    for (std::size_t t = 0; t < pattern.face_triangles.size(); t += 3) {
      std::vector<std::pair<float, ClearancePlane>> outside, inside;
      std::uint32_t v[3];
      Vec3 p[3];
      float bulge_up = 0.0f, bulge_down = 0.0f;
      for (std::size_t k = 0; k < 3; ++k) {
        v[k] = of_face[pattern.face_triangles[t + k]], p[k] = at[v[k]];
        const Vec3 moved = s.drawn(v[k]) - p[k];
        const float rise = dot(moved, up), aside = length(moved - up * rise);
        bulge_up = std::max(bulge_up, std::max(rise, 0.0f) + aside);
        bulge_down = std::max(bulge_down, std::max(-rise, 0.0f) + aside);
      }
      for (std::uint32_t b = 0; b < s.mesh.triangles.size() / 3; ++b) {
        const MeshPose::Corners corners = pose.corners(b);
        const Vec3 q[3] = {corners.a, corners.b, corners.c};
        const float h[3] = {dot(q[0] - face, up), dot(q[1] - face, up), dot(q[2] - face, up)};
        const float limit = kept + (std::min({h[0], h[1], h[2]}) > 0.0f   ? bulge_up
                                    : std::max({h[0], h[1], h[2]}) < 0.0f ? bulge_down
                                                                          : std::max(bulge_up, bulge_down));
        const TrianglePair pair = closest_between_triangles(p, q);
        const Vec3 surface = pair.second.point(q[0], q[1], q[2]), away = pair.first.point(p[0], p[1], p[2]) - surface;
        const float distance = length(away);
        if (distance >= limit) continue;
        const Vec3 direction = normalized_or(away, Vec3{});
        if (pair.second.zeros() == 2 &&
            !pose.look_around(pose.corner(b, pair.second.corner()), direction, 0.02f).stands_out(1.0f)) {
          continue;
        }
        if (pair.second.zeros() == 1) {
          const auto edge = static_cast<std::uint32_t>(pair.second.edge());
          const MeshPose::Corners next = pose.corners(pose.topology.neighbour[3 * b + edge]);
          bool rises = false;
          for (int k = 0; k < 3; ++k) {
            rises = rises || dot(next[k] - surface, direction) > 0.02f * length(next[k] - surface);
          }
          if (rises) continue;
        }
        const Vec3 outward = pose.outward(b, pair.second).normal;
        const bool is_outside = dot(away, outward) >= 0.0f;
        if (!is_outside && distance > s.mesh.depth) continue;
        const Vec3 normal =
            pair.second.zeros() == 0 ? normalized_or(outward, Vec3{}) : direction * (is_outside ? 1.0f : -1.0f);
        (is_outside ? outside : inside)
            .push_back({distance, {normal, dot(normal, surface) + kept, {v[0], v[1], v[2]}}});
      }
      const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
      std::ranges::sort(outside, nearer), std::ranges::sort(inside, nearer);
      if (!inside.empty() && (outside.empty() || nearer(inside.front(), outside.front()))) {
        planes.push_back({inside.front().second});
      } else if (!outside.empty()) {
        planes.emplace_back();
        for (const auto& found : outside) planes.back().push_back(found.second);
      }
    }
  }
  return planes;
}

TEST(MeshClearance, PropertyEveryVectorSetFindsThePlanesThatPairsOneByOneHave) {
  const VectorSet limit = vector_limit;
  for (const std::uint32_t level : {0u, 3u}) {
    for (const BodyShape& shape : {icosphere(2, 0.3f), box_shape({0.2f, 0.2f, 0.33f})}) {
      Sagging s(0.008f, under_sheet(shape, 0.2f, 0.013f, 0.004f), level);
      const std::vector<std::vector<ClearancePlane>> expected = plain_planes(s);
      ASSERT_GT(expected.size(), 10u);
      for (const VectorSet set : kVectorSets) {
        vector_limit = set;
        s.count = 0;
        s.system().run();
        std::uint32_t next = 0;
        for (const std::vector<ClearancePlane>& planes : expected) {
          ASSERT_LE(planes.size(), 8u);
          ASSERT_LE(next + planes.size(), s.count);
          for (std::size_t k = 0; k < planes.size(); ++k, ++next) {
            const ClearancePlane& found = s.planes[next];
            EXPECT_TRUE(std::ranges::any_of(planes,
                                            [&](const ClearancePlane& p) {
                                              return std::ranges::equal(p.vertex, found.vertex) &&
                                                     length(p.normal - found.normal) < 1e-5f &&
                                                     std::abs(p.height - found.height) < 1e-6f;
                                            }))
                << "plane " << next << ", level " << level;
          }
        }
        EXPECT_EQ(next, s.count);
      }
    }
  }
  vector_limit = limit;
}

TEST(MeshClearance, PropertyEveryVectorSetGivesTheSameBits) {
  const VectorSet limit = vector_limit;
  std::vector<Vec3> expected;
  for (const VectorSet set : kVectorSets) {
    vector_limit = set;
    Sagging s(0.03f, under_sheet(icosphere(3, 0.3f), 0.2f, 0.013f));
    s.run();
    if (set == VectorSet::kBaseline) expected = s.all_drawn();
    EXPECT_EQ(s.all_drawn(), expected);
  }
  vector_limit = limit;
}

TEST(MeshClearance, ValidateNamesWhatIsMissing) {
  Sagging s(0.03f, under_sheet(icosphere(0, 0.3f)));
  const MeshClearance good = s.system();
  EXPECT_TRUE(good.validate());
  MeshClearance bad = good;
  bad.bodies = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.meshes = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.near.place = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.planes.capacity = 0;
  EXPECT_FALSE(bad.validate());
  bad = good, bad.footprint = {};
  EXPECT_FALSE(bad.validate());
  bad = good, bad.clearance = -1.0f;
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat::test
