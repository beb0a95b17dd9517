#include "systems/capsule_detection.h"

#include <gtest/gtest.h>

#include <random>

#include "systems/capsule_shape.h"
#include "systems/closest_points.h"
#include "systems/collision_response.h"
#include "systems/contact_row.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kThickness = 0.005f, kDt = 0.002f;

/// With every feature a candidate.
CapsuleDetection detection(ContactCloth& cloth, const std::vector<CapsulePose>& capsules) {
  cloth.row_count = 0;
  cloth.candidates.make_room(cloth.garment, capsules.size());
  list_everything(cloth.garment, static_cast<std::uint32_t>(capsules.size()), cloth.candidates);
  cloth.blocks.resize(capsule_blocks(capsules.size()));
  return {&cloth.garment,
          cloth.packed_position(),
          cloth.packed_previous(),
          capsules.data(),
          static_cast<std::uint32_t>(capsules.size()),
          kThickness,
          cloth.margin(),
          0.5f,
          kDt,
          &cloth.candidates,
          cloth.contacts(),
          cloth.blocks.data()};
}

void respond(ContactCloth& cloth, int passes, FaceResponse response = FaceResponse::kWeighted) {
  Stats stats;
  for (int i = 0; i < passes; ++i) {
    cloth.run(CollisionResponse{.contacts = cloth.contacts(), .face_response = response}, stats);
  }
}

float depth(const Vec3& p, const CapsulePose& c) {
  return c.radius - length(p - lerp(c.a, c.b, closest_on_segment(p, c.a, c.b)));
}

/// The deepest of 45 points of the first face.
float face_depth(const ContactCloth& cloth, const CapsulePose& c) {
  float deepest = -1.0f;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 8 - i; ++j) {
      const float a = static_cast<float>(i) / 8.0f, b = static_cast<float>(j) / 8.0f;
      const auto& corner = cloth.garment.face_particle;
      const Vec3 p = cloth.x(corner[0][0]) * a + cloth.x(corner[1][0]) * b + cloth.x(corner[2][0]) * (1.0f - a - b);
      deepest = std::max(deepest, depth(p, c));
    }
  }
  return deepest;
}

TEST(CapsuleDetection, ParticleIsPushedToSurfaceAndThickness) {
  ContactCloth cloth({{0.099f, 0.0f, 0.0f}, {1, 0, 0}, {1, 0, 1}}, {{0, 1, 2}});
  const std::vector<CapsulePose> capsules = {
      {.a = {0, -1, 0}, .b = {0, 1, 0}, .step_a = {}, .step_b = {}, .radius = 0.1f}};
  Stats stats;
  const CapsuleDetection system = detection(cloth, capsules);
  ASSERT_TRUE(system.validate());
  system.run(stats);
  respond(cloth, 1);
  EXPECT_NEAR(cloth.x(0).x, 0.1f + 0.003f, 1e-6f);  // 1 mm deep at the start: 2 m/s brings back 4 mm in a substep
  cloth.put(0, {0.099f, 0, 0}, {0.11f, 0, 0});      // came in during the substep: all of it is undone
  detection(cloth, capsules).run(stats);
  respond(cloth, 1);
  EXPECT_NEAR(cloth.x(0).x, 0.105f, 1e-6f);
}

TEST(CapsuleDetection, PastTheCoreReturnsToItsSide) {
  ContactCloth cloth({{0.02f, 0.0f, 0.0f}, {1, 0, 0}, {1, 0, 1}}, {{0, 1, 2}});
  cloth.put(0, {-0.004f, 0, 0}, {0.026f, 0, 0});
  Stats stats;
  detection(cloth, {{.a = {0, -1, 0}, .b = {0, 1, 0}, .step_a = {}, .step_b = {}, .radius = 0.02f}}).run(stats);
  respond(cloth, 1);
  EXPECT_NEAR(cloth.x(0).x, 0.025f, 1e-6f);
}

TEST(CapsuleDetection, FaceCutWithoutCornerInsideComesOutAtEveryPoint) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  int cut = 0, through = 0;
  for (int n = 0; n < 4000; ++n) {
    const CapsulePose capsule{.a = {-0.05f, 0, 0},
                              .b = {0.05f + 0.05f * any(random), 0, 0.03f * any(random)},
                              .step_a = {},
                              .step_b = {},
                              .radius = 0.06f};
    // A face that came down on the capsule: 8 mm in the substep, the corners beside it.
    std::vector<Vec3> x(3);
    for (std::size_t k = 0; k < 3; ++k) {
      const float angle = (static_cast<float>(k) + 0.5f * any(random)) * 2.0944f;
      x[k] = {0.2f * std::cos(angle), 0.06f + 0.02f * any(random), -0.2f * std::sin(angle)};
    }
    ContactCloth cloth(x, {{0, 1, 2}});
    for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, x[i], x[i] + Vec3{0, 0.012f, 0});
    const Vec3 up{0, 0.012f, 0};
    const bool began_outside = [&] {
      ContactCloth before({x[0] + up, x[1] + up, x[2] + up}, {{0, 1, 2}});
      return face_depth(before, capsule) < 0.0f;
    }();
    if (!began_outside || face_depth(cloth, capsule) < 0.001f) continue;
    ++cut;
    Stats stats;
    detection(cloth, {capsule}).run(stats);
    respond(cloth, 8);
    const float left = face_depth(cloth, capsule);
    if (left > 0.0f) ++through;
    EXPECT_LT(left, 0.001f) << "case " << n;
  }
  EXPECT_GT(cut, 300);
  EXPECT_EQ(through, 0);
}

TEST(CapsuleDetection, WholeResponseMovesAllCornersAlike) {
  const std::vector<Vec3> x = {{-0.2f, 0, -0.1f}, {0.2f, 0, -0.12f}, {0, 0, 0.2f}};
  ContactCloth cloth(x, {{0, 2, 1}});
  for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, x[i], x[i] + Vec3{0, 0.02f, 0});
  Stats stats;
  detection(cloth, {{.a = {0.02f, -0.05f, 0}, .b = {0.02f, -0.5f, 0}, .step_a = {}, .step_b = {}, .radius = 0.06f}})
      .run(stats);
  ASSERT_EQ(cloth.row_count, 1u);
  respond(cloth, 1, FaceResponse::kWhole);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(length(cloth.x(i) - x[i] - Vec3{0, 0.015f, 0}), 0.0f, 1e-6f);  // 0.06 - 0.05 + thickness
  }
}

TEST(CapsuleDetection, MovingCapsuleCarriesTheParticle) {
  ContactCloth cloth({{0.105f, 0.0f, 0.0f}, {1, 0, 0}, {1, 0, 1}}, {{0, 1, 2}});
  Stats stats;
  for (int n = 1; n <= 100; ++n) {  // 5 m/s, 10 mm a substep
    const float x = 0.01f * static_cast<float>(n);
    cloth.put(0, cloth.x(0), cloth.x(0));
    detection(cloth,
              {{.a = {x, -1, 0}, .b = {x, 1, 0}, .step_a = {0.01f, 0, 0}, .step_b = {0.01f, 0, 0}, .radius = 0.1f}})
        .run(stats);
    respond(cloth, 1);
    ASSERT_NEAR(cloth.x(0).x, x + 0.105f, 1e-5f);
  }
}

TEST(CapsuleDetection, OverlappingCapsulesMeetHalfWay) {
  // 20 mm deep in each other: their surfaces are at z = 10 mm and z = -10 mm.
  const std::vector<CapsulePose> capsules = {
      {.a = {-1, 0, -0.07f}, .b = {1, 0, -0.07f}, .step_a = {}, .step_b = {}, .radius = 0.08f},
      {.a = {-1, 0, 0.07f}, .b = {1, 0, 0.07f}, .step_a = {}, .step_b = {}, .radius = 0.08f}};
  for (const float z : {-0.012f, 0.0f, 0.004f}) {
    ContactCloth cloth({{0, 0, z}, {0.2f, 0.2f, z}, {0.2f, -0.2f, z}}, {{0, 1, 2}});
    Stats stats;
    for (int substep = 0; substep < 10; ++substep) {
      for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, cloth.x(i), cloth.x(i));
      detection(cloth, capsules).run(stats);
      respond(cloth, 3);
    }
    EXPECT_NEAR(cloth.x(0).z, 0.0f, 1e-5f) << z;
    const Vec3 edge = (cloth.x(1) + cloth.x(2)) * 0.5f;  // passes between them too
    EXPECT_NEAR(edge.z, 0.0f, 1e-4f) << z;
    const Vec3 rest = cloth.x(0);
    detection(cloth, capsules).run(stats);
    respond(cloth, 1);
    EXPECT_LT(length(cloth.x(0) - rest), 1e-6f) << z;  // the one does not undo what the other does
  }
}

/// What of its distance to `own` a place gives up to each of the others: the most of them.
float given_up(const std::vector<CapsulePose>& capsules, std::size_t own, const Vec3& p, const Vec3& normal,
               float missing) {
  float most = 0.0f;
  for (std::size_t c = 0; c < capsules.size(); ++c) {
    const float t = closest_on_capsule(p, capsules[c]);
    const Vec3 away = p - lerp(capsules[c].a, capsules[c].b, t);
    const float d = length(away), lacks = radius_at(capsules[c], t) + kThickness + missing - d;
    const float facing = -dot(normal, away) / d;
    if (c != own && lacks > 0.0f && facing > 0.0f) most = std::max(most, 0.5f * lacks * std::min(1.0f, 2.0f * facing));
  }
  return most;
}

TEST(CapsuleDetection, GivesWayToWhicheverCapsulePressesMost) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  int rows = 0, gave_way = 0, to_one_beyond_eight = 0;
  for (int n = 0; n < 10000; ++n) {
    std::vector<CapsulePose> capsules(1 + random() % 20);
    for (CapsulePose& c : capsules) {
      c.a = Vec3{any(random), any(random), any(random)} * 0.3f, c.b = c.a + Vec3{any(random), 0.1f, any(random)} * 0.3f;
      c.radius = 0.1f, c.taper = random() % 3 == 0 ? 0.04f * any(random) : 0.0f;
      if (random() % 5 == 0) c.b = c.a, c.taper = 0.0f;
    }
    const Vec3 p = Vec3{any(random), any(random), any(random)} * 0.2f;
    ContactCloth cloth({p, {9, 0, 0}, {9, 0, 1}}, {{0, 1, 2}});
    Stats stats;
    detection(cloth, capsules).run(stats);
    std::size_t c = 0;
    for (std::uint32_t k = 0; k < cloth.row_count; ++k) {
      const ContactRow& row = cloth.rows[k];
      if (!row.at_particle()) continue;
      // Whose row it is: the next one that is near enough.
      float t = 0.0f;
      Vec3 away;
      for (;; ++c) {
        t = closest_on_capsule(p, capsules[c]), away = p - lerp(capsules[c].a, capsules[c].b, t);
        if (length(away) < widest_radius(capsules[c]) + kThickness + kLeastCapsuleMargin) break;
      }
      const float distance = radius_at(capsules[c], t) + kThickness;
      const float given = given_up(capsules, c, p, row.normal, distance - length(away));
      const float surface = dot(row.normal, lerp(capsules[c].a, capsules[c].b, t));
      const float most = dot(row.normal, p) + kRecoverySpeed * kDt;
      EXPECT_NEAR(row.offset, std::min(surface + distance - given, most), 2e-6f) << n;
      if (surface + distance - given < most) {
        ++rows, gave_way += given > 0.0f;
        const std::vector<CapsulePose> first(capsules.begin(),
                                             capsules.begin() + std::min<long>(8, std::ssize(capsules)));
        to_one_beyond_eight += c < 8 && given_up(first, c, p, row.normal, distance - length(away)) < given;
      }
      ++c;
    }
  }
  EXPECT_GT(rows, 1000);
  EXPECT_GT(gave_way, 500);
  EXPECT_GT(to_one_beyond_eight, 50);
}

TEST(CapsuleDetection, ACreaseBetweenCapsulesIsNoPinch) {
  const std::vector<CapsulePose> capsules = {
      {.a = {-1, -0.07f, 0}, .b = {1, -0.07f, 0}, .step_a = {}, .step_b = {}, .radius = 0.08f},
      {.a = {-1, 0, -0.07f}, .b = {1, 0, -0.07f}, .step_a = {}, .step_b = {}, .radius = 0.08f}};
  ContactCloth cloth({{0, 0.01f, 0.01f}, {0.5f, 0.3f, 0.3f}, {0.5f, 0.3f, 0.2f}}, {{0, 1, 2}});
  Stats stats;
  for (int substep = 0; substep < 40; ++substep) {
    for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, cloth.x(i), cloth.x(i));
    detection(cloth, capsules).run(stats);
    respond(cloth, 3);
  }
  for (const CapsulePose& capsule : capsules) EXPECT_LT(depth(cloth.x(0), capsule), -kThickness + 1e-5f);
}

TEST(CapsuleDetection, NothingFliesOffWhereABodyPressesAgainstAPin) {
  // The body is 5 mm too near to edges that a pin holds 10 mm further on: to move them off it, their free ends would
  // have to move 150 mm.
  ContactCloth cloth({{0, 0, 0}, {0.3f, 0, 0}, {0.3f, 0, 0.1f}}, {{0, 2, 1}}, {0});
  const std::vector<CapsulePose> capsules = {
      {.a = {0.01f, -0.1f, -1}, .b = {0.01f, -0.1f, 1}, .step_a = {}, .step_b = {}, .radius = 0.1f}};
  Stats stats;
  detection(cloth, capsules).run(stats);
  ASSERT_GT(cloth.row_count, 0u);
  respond(cloth, 4);
  for (const std::uint32_t i : {1u, 2u}) {
    EXPECT_GT(cloth.x(i).y, 1e-4f);
    EXPECT_LT(cloth.x(i).y, 0.015f);
  }
}

TEST(CapsuleDetection, DegenerateFeaturesMakeFiniteRows) {
  const std::vector<Vec3> same = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, line = {{0, -1, 0}, {0, 0, 0}, {0, 1, 0}};
  for (const std::vector<Vec3>& x : {same, line}) {
    ContactCloth cloth({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    for (std::uint32_t i = 0; i < 3; ++i) cloth.put(i, x[i], x[i]);
    Stats stats;
    detection(cloth, {{.a = {0, -1, 0}, .b = {0, 1, 0}, .step_a = {}, .step_b = {}, .radius = 0.0f},
                      {.a = {0, 0, 0}, .b = {0, 0, 0}, .step_a = {}, .step_b = {}, .radius = 0.1f}})
        .run(stats);
    EXPECT_GT(cloth.row_count, 0u);
    for (std::uint32_t c = 0; c < cloth.row_count; ++c) {
      const ContactRow& row = cloth.rows[c];
      EXPECT_TRUE(std::isfinite(row.offset));
      for (std::uint32_t k = 0; k < row.count; ++k) EXPECT_TRUE(std::isfinite(row.share[k]));
      EXPECT_NEAR(length(row.normal), 1.0f, 1e-5f);
    }
    respond(cloth, 3);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_TRUE(is_finite(cloth.x(i)));
  }
}

TEST(CapsuleDetection, PinnedFacesMakeNoRowsAndFullListsAreCounted) {
  const std::vector<CapsulePose> capsules = {
      {.a = {0, -1, 0}, .b = {0, 1, 0}, .step_a = {}, .step_b = {}, .radius = 0.5f}};
  ContactCloth pinned({{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}}, {{0, 2, 1}}, {0, 1, 2});
  Stats stats;
  detection(pinned, capsules).run(stats);
  EXPECT_EQ(pinned.row_count, 0u);

  ContactCloth cloth({{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}}, {{0, 2, 1}});
  detection(cloth, capsules).run(stats);
  const std::uint32_t all = cloth.row_count;
  ASSERT_GT(all, 2u);
  cloth.rows.resize(2);
  detection(cloth, capsules).run(stats);
  EXPECT_EQ(cloth.row_count, 2u);
  EXPECT_EQ(stats.contacts_dropped, all - 2);
}

TEST(CapsuleDetection, ValidateRefusesBrokenFields) {
  ContactCloth cloth({{0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}}, {{0, 2, 1}});
  const CapsuleDetection good = detection(cloth, {});
  EXPECT_TRUE(good.validate());
  CapsuleDetection bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good;
  bad.capsule_count = 1;
  bad.capsules = nullptr;
  EXPECT_FALSE(bad.validate());
  const std::vector<CapsulePose> one(1);
  bad = detection(cloth, one);
  EXPECT_TRUE(bad.validate());
  bad.blocks = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good;
  bad.dt = 0.0f;
  EXPECT_FALSE(bad.validate());
  bad = good;
  bad.thickness = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat::test
