#include "systems/mesh_detection.h"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "systems/closest_points.h"
#include "systems/collision_response.h"
#include "systems/mesh_candidates.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kThickness = 0.005f, kDt = 0.002f;

/// One body and what is needed to ask about it.
struct Body {
  MeshCollider mesh;
  const MeshCollider* pointer = &mesh;
  CollisionBodies bodies{memory()};

  explicit Body(const BodyShape& shape) : mesh(make_body(shape.positions, shape.triangles)) { bodies.add_mesh(mesh); }

  MeshDetection detection(ContactCloth& cloth, float t0 = 0.0f, float t1 = 1.0f) {
    cloth.row_count = 0;
    return {&cloth.garment,
            cloth.position.view(),
            cloth.packed_position(),
            cloth.previous.view(),
            cloth.inverse_mass.data(),
            {},
            &bodies,
            &pointer,
            nullptr,
            t0,
            t1,
            kThickness,
            0.5f,
            kDt,
            cloth.contacts()};
  }
  void touch(ContactCloth& cloth, int passes = 4) {
    Stats stats;
    detection(cloth).run(stats);
    EXPECT_EQ(stats.contacts_dropped, 0u);
    for (int i = 0; i < passes; ++i) cloth.run(CollisionResponse{.contacts = cloth.contacts()}, stats);
  }
};

/// A face so small that it is a particle.
ContactCloth speck(const Vec3& at, const Vec3& before) {
  ContactCloth cloth({at, at + Vec3{1e-4f, 0, 0}, at + Vec3{0, 0, 1e-4f}}, {{0, 2, 1}});
  for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, cloth.x(i), cloth.x(i) + (before - at));
  return cloth;
}

TEST(MeshDetection, SphereMeshAgreesWithTheSphere) {
  Body body(icosphere(4, 0.3f));  // its triangles lie up to 0.4 mm inside the sphere
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 way = normalized_or(Vec3{normal(random), normal(random), normal(random)}, {0, 1, 0});
    const float gap = -0.025f + 0.00002f * static_cast<float>(n);  // from 25 mm inside to 15 mm outside
    ContactCloth cloth = speck(way * (0.3f + gap), way * 0.31f);
    body.touch(cloth);
    EXPECT_NEAR(length(cloth.x(0)), std::max(0.305f, 0.3f + gap), 0.001f) << "gap " << gap;
  }
}

TEST(MeshDetection, BoxCornersAndEdgesTellInsideFromOutside) {
  Body body(box_shape({0.1f, 0.1f, 0.1f}));
  std::mt19937 random(8);
  std::uniform_real_distribution<float> any(-0.12f, 0.12f);
  const auto clearance = [](const Vec3& p) {  // signed distance from the box
    const Vec3 q{std::abs(p.x) - 0.1f, std::abs(p.y) - 0.1f, std::abs(p.z) - 0.1f};
    const Vec3 out{std::max(q.x, 0.0f), std::max(q.y, 0.0f), std::max(q.z, 0.0f)};
    return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0f);
  };
  int inside = 0;
  for (int n = 0; n < 4000; ++n) {
    const Vec3 p{any(random), any(random), any(random)};
    const float gap = clearance(p);
    if (gap < -0.029f || std::abs(gap + 0.03f) < 1e-3f) continue;
    inside += gap < 0.0f;
    // It came in through the nearest side.
    Vec3 before = p;
    const Vec3 deep{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
    const float most = std::max({deep.x, deep.y, deep.z});
    (most == deep.x ? before.x : most == deep.y ? before.y : before.z) *= 0.106f / most;
    ContactCloth cloth = speck(p, before);
    body.touch(cloth);
    EXPECT_GT(clearance(cloth.x(0)), kThickness - 4e-4f) << "gap " << gap << " at " << p.x << ' ' << p.y << ' ' << p.z;
    EXPECT_LT(clearance(cloth.x(0)), std::max(kThickness, gap) + 4e-4f);
  }
  EXPECT_GT(inside, 1000);
}

TEST(MeshDetection, RidgeCutsNoEdgeAndCornerNoFace) {
  // A large face comes down on a box whose top edge, or corner, points at it; its own corners stay far outside.
  const BodyShape box = box_shape({0.1f, 0.1f, 0.1f});
  for (const bool on_corner : {false, true}) {
    BodyShape turned = box;
    for (Vec3& p : turned.positions) {
      const float c = std::sqrt(0.5f);
      p = {c * (p.x - p.y), c * (p.x + p.y), p.z};  // an edge along z on top, y = 0.1414
      const float d = std::sqrt(1.0f / 3.0f), e = std::sqrt(2.0f / 3.0f);
      if (on_corner) p = {p.x, e * p.y + d * p.z, -d * p.y + e * p.z};  // a corner on top, y = 0.1732
    }
    const float top = on_corner ? 0.17320508f : 0.14142136f;
    Body body(turned);
    // For the ridge the face's edges cross it, beside the ridge's own ends.
    const float y = top - 0.003f;
    const std::vector<Vec3> x = {{-0.3f, y, -0.05f}, {0.3f, y, -0.05f}, {0.0f, y, 0.3f}};
    ContactCloth cloth(x, {{0, 2, 1}});
    for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, x[i], x[i] + Vec3{0, 0.01f, 0});
    body.touch(cloth, 20);
    ASSERT_GT(cloth.row_count, 0u);
    for (std::uint32_t c = 0; c < cloth.row_count; ++c) {
      const ContactRow& row = cloth.rows[c];
      EXPECT_GT(row.normal.y, 0.99f);
      EXPECT_GT(dot(row.normal, contact_point(row, ConstVec3View(cloth.position.view()))), top + kThickness - 1e-4f);
    }
  }
}

TEST(MeshDetection, EdgeOnTwoRidgesHasARowAtBoth) {
  // However it is tilted by a substep, else it falls to the ridge without a row and to the other one by turns.
  Body body(box_shape({0.1f, 0.1f, 0.1f}));
  for (const float tilt : {-0.02f, 0.0f, 0.02f}) {
    ContactCloth cloth({{-0.2f, 0.105f - 0.2f * tilt, 0}, {0.2f, 0.105f + 0.2f * tilt, 0}, {0, 0.6f, 0}}, {{0, 1, 2}});
    Stats stats;
    body.detection(cloth).run(stats);
    bool left = false, right = false;
    for (std::uint32_t c = 0; c < cloth.row_count; ++c) {
      const float x = contact_point(cloth.rows[c], ConstVec3View(cloth.position.view())).x;
      left = left || std::abs(x + 0.1f) < 1e-3f;
      right = right || std::abs(x - 0.1f) < 1e-3f;
    }
    EXPECT_TRUE(left && right) << "tilt " << tilt;
  }
}

TEST(MeshDetection, FaceOnFourCornersHasARowAtEach) {
  Body body(box_shape({0.1f, 0.1f, 0.1f}));
  for (const float tilt : {-0.07f, 0.0f, 0.07f}) {
    const auto at = [&](float x, float z) { return Vec3{x, 0.107f + tilt * x, z}; };
    ContactCloth cloth({at(-0.5f, -0.3f), at(0, 0.6f), at(0.5f, -0.3f)}, {{0, 1, 2}});
    Stats stats;
    body.detection(cloth).run(stats);
    int corners = 0;
    for (std::uint32_t c = 0; c < cloth.row_count; ++c) {
      const Vec3 p = contact_point(cloth.rows[c], ConstVec3View(cloth.position.view()));
      corners += std::abs(std::abs(p.x) - 0.1f) < 1e-3f && std::abs(std::abs(p.z) - 0.1f) < 1e-3f;
    }
    EXPECT_EQ(corners, 4) << "tilt " << tilt;
  }
}

TEST(MeshDetection, ClothFoldedAroundACornerMeetsIt) {
  // The tip of a flat pyramid below the fold of a steep valley: over neither face, and off the ends of all ridges.
  const BodyShape pyramid{{{0.5f, 0, 0}, {0, 0, -0.5f}, {-0.5f, 0, 0}, {0, 0, 0.5f}, {0, 0.1f, 0}, {0, -0.3f, 0}},
                          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
  Body body(pyramid);
  for (const float height : {0.001f, 0.004f}) {
    const float y = 0.1f + height;
    ContactCloth cloth({{-0.05f, y, -0.02f}, {0.05f, y, 0.02f}, {-0.02f, 0.2f, 0.05f}, {0.02f, 0.2f, -0.05f}},
                       {{0, 2, 1}, {0, 1, 3}});
    for (std::uint32_t i = 0; i < 4; ++i) cloth.put(i, cloth.x(i), cloth.x(i) + Vec3{0, 0.1f + kThickness - y, 0});
    body.touch(cloth, 20);
    const Vec3 middle = (cloth.x(0) + cloth.x(1)) * 0.5f;
    EXPECT_NEAR(middle.y, 0.1f + kThickness, 1e-4f) << "from " << height;
  }
}

TEST(MeshDetection, MovingBodyIsMetWhereItIsInTheSubstep) {
  Body body(icosphere(3, 0.3f));
  for (std::size_t i = 0; i < body.mesh.next.size(); ++i) {
    body.mesh.next.view().add(i, {0, 0.04f, 0});
  }
  body.bodies.update_mesh(0, body.mesh);
  ContactCloth cloth = speck({0, 0.315f, 0}, {0, 0.315f, 0});
  Stats stats;
  body.detection(cloth, 0.25f, 0.5f).run(stats);
  ASSERT_GT(cloth.row_count, 0u);
  const ContactRow& row = cloth.rows[0];
  EXPECT_NEAR(length(row.body_step - Vec3{0, 0.01f, 0}), 0.0f, 1e-6f);
  EXPECT_NEAR(row.offset, 0.3f + 0.02f + kThickness, 2e-3f);
}

TEST(MeshDetection, RowsStayFewOnAFineBody) {
  Body body(icosphere(5, 0.3f));  // 20,480 triangles of 1 cm
  std::vector<Vec3> x = {{-0.1f, 0.303f, -0.06f}, {0.1f, 0.303f, -0.06f}, {0, 0.303f, 0.12f}};
  ContactCloth cloth(x, {{0, 2, 1}});
  Stats stats;
  body.detection(cloth).run(stats);
  EXPECT_GE(cloth.row_count, 1u);
  EXPECT_LE(cloth.row_count, 10u);
}

TEST(MeshDetection, DegenerateFeaturesMakeFiniteRows) {
  BodyShape shape = box_shape({0.1f, 0.1f, 0.1f});
  shape.triangles.push_back({0, 0, 1});
  shape.triangles.push_back({2, 2, 2});
  shape.positions[7] = shape.positions[6];  // folds two sides flat
  Body body(shape);
  ContactCloth cloth({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const Vec3& at : shape.positions) {
    for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, at, at);
    body.touch(cloth);
    for (std::uint32_t c = 0; c < cloth.row_count; ++c) {
      EXPECT_NEAR(length(cloth.rows[c].normal), 1.0f, 1e-4f);
      EXPECT_TRUE(std::isfinite(cloth.rows[c].offset));
    }
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_TRUE(is_finite(cloth.x(i)));
  }
}

TEST(MeshDetection, DisabledBodiesAreNotMet) {
  Body body(icosphere(2, 0.3f));
  body.mesh.enabled = false;
  ContactCloth cloth = speck({0, 0.3f, 0}, {0, 0.3f, 0});
  Stats stats;
  const MeshDetection system = body.detection(cloth);
  EXPECT_TRUE(system.validate());
  system.run(stats);
  EXPECT_EQ(cloth.row_count, 0u);
  MeshDetection bad = system;
  bad.meshes = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = system;
  bad.t1 = 1.5f;
  EXPECT_FALSE(bad.validate());
}

auto told_by(const ContactRow& row) {
  return std::tuple(row.particle[0], row.particle[1], row.particle[2], row.weight[0], row.weight[1], row.normal.x,
                    row.normal.y, row.normal.z, row.offset);
}
std::vector<ContactRow> rows_of(const ContactCloth& cloth) {
  return {cloth.rows.begin(), cloth.rows.begin() + cloth.row_count};
}

/// Through a tick of several substeps, while cloth and body move as they like: the rows found among the candidates are
/// those found by asking the tree, one by one, in the same order.
TEST(MeshDetection, CandidatesGiveTheRowsOfTheTree) {
  constexpr int kSubsteps = 10;
  std::mt19937 random(12);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const float u = static_cast<float>(i % 8) / 7.0f, v = static_cast<float>(i / 8) / 7.0f;
    x.push_back({0.5f * u - 0.25f, 0.31f + 0.02f * any(random), 0.5f * v - 0.25f});
    if (i % 8 == 7 || i >= 56) continue;
    triangles.push_back({i, i + 8, i + 1});
    triangles.push_back({i + 1, i + 8, i + 9});
  }
  std::size_t rows = 0, gathered = 0, kept = 0;
  for (int tick = 0; tick < 30; ++tick) {
    Body body(icosphere(3, 0.3f));
    const Vec3 shift = Vec3{any(random), any(random), any(random)} * 0.08f;
    for (std::size_t i = 0; i < body.mesh.next.size(); ++i) {
      body.mesh.next.view().add(i,
                                shift + body.mesh.next.view()[i] * (0.2f * any(random) * static_cast<float>(tick % 2)));
    }
    body.bodies.update_mesh(0, body.mesh);
    ContactCloth cloth(x, triangles);
    MeshCandidateColumns candidates(memory());
    const std::size_t pairs = tick == 7 ? 20 : 80000;  // in one of them there is no room
    candidates.make_room(cloth.garment.particle_count, 1, body.mesh.next.size(), body.mesh.triangles.size() / 3, pairs);
    const float wild = tick % 3 == 2 ? 0.02f : 0.001f;  // m a substep off the predicted path
    for (int s = 0; s < kSubsteps; ++s) {
      const float t0 = static_cast<float>(s) / kSubsteps, t1 = static_cast<float>(s + 1) / kSubsteps;
      for (std::uint32_t i = 0; i < cloth.garment.particle_count; ++i) {
        const Vec3 step = shift * (1.1f / kSubsteps);
        cloth.velocity.view().set(i, step * (1.0f / kDt));
        cloth.put(i, cloth.x(i) + step + Vec3{any(random), any(random), any(random)} * wild, cloth.x(i));
      }
      const std::uint32_t before = candidates.edges.count;
      const float anchored = candidates.t_anchor;
      MeshCandidates{&cloth.garment,
                     cloth.position.view(),
                     cloth.previous.view(),
                     cloth.velocity.view(),
                     cloth.inverse_mass.data(),
                     {},
                     &body.bodies,
                     &body.pointer,
                     t0,
                     t1,
                     kThickness,
                     kDt,
                     &candidates}
          .run();
      EXPECT_EQ(candidates.complete, tick != 7);
      ++(candidates.t_anchor != anchored || candidates.edges.count != before ? gathered : kept);
      Stats stats;
      MeshDetection among = body.detection(cloth, t0, t1);
      among.candidates = &candidates;
      among.run(stats);
      const std::vector<ContactRow> found = rows_of(cloth);
      body.detection(cloth, t0, t1).run(stats);
      const std::vector<ContactRow> expected = rows_of(cloth);
      ASSERT_EQ(found.size(), expected.size()) << "tick " << tick << " substep " << s;
      rows += found.size();
      for (std::size_t r = 0; r < found.size(); ++r) EXPECT_EQ(told_by(found[r]), told_by(expected[r]));
    }
  }
  EXPECT_GT(rows, 5000u);
  EXPECT_GT(gathered, 60u);
  EXPECT_GT(kept, 100u);
}

}  // namespace
}  // namespace pleat::test
