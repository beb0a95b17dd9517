#include "systems/self_detection.h"

#include <gtest/gtest.h>

#include <random>

#include "systems/closest_points.h"
#include "systems/collision_response.h"
#include "systems/contact_friction.h"
#include "systems/self_candidates.h"
#include "systems/velocity_update.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kDistance = 0.005f, kDt = 0.002f;

/// A cloth and what contact with itself keeps.
struct SelfCloth : ContactCloth {
  std::vector<NearPair> pairs;
  NearScratch scratch{memory()};
  Vec3Column sought_at{memory()};
  std::uint32_t pair_count = SelfCandidates::kNeverSought;
  Stats stats;

  using ContactCloth::ContactCloth;

  SelfCandidates candidates(float distance = kDistance) {
    const std::uint32_t n = garment.particle_count, capacity = 64 * n;
    pairs.resize(capacity), scratch.pairs.resize(capacity);
    scratch.make_room(garment.particle_count, garment.edge_count);
    sought_at.resize(n);
    return {.garment = &garment,
            .position = position.view(),
            .previous = previous.view(),
            .distance = distance,
            .pairs = {pairs.data(), capacity, &pair_count},
            .sought_at = sought_at.view(),
            .scratch = &scratch};
  }
  void detect(float distance = kDistance, float friction = 0.0f) {
    const SelfCandidates search = candidates(distance);
    ASSERT_TRUE(search.validate());
    search.run(stats);
    row_count = 0;
    const SelfDetection detection{.garment = &garment,
                                  .position = packed_position(),
                                  .begin = packed_previous(),
                                  .previous = previous.view(),
                                  .inverse_mass = inverse_mass.data(),
                                  .pairs = search.pairs,
                                  .friction = friction,
                                  .dt = kDt,
                                  .contacts = contacts()};
    ASSERT_TRUE(detection.validate());
    detection.run(stats);
  }
  void respond() { run(CollisionResponse{.contacts = contacts()}, stats); }
  /// A substep of free flight and contact.
  void substep() {
    for (std::uint32_t i = 0; i < garment.particle_count; ++i) {
      previous.view().set(i, x(i));
      position.view().add(i, velocity.view()[i] * kDt);
      predicted.view().set(i, x(i));
    }
    detect();
    for (int sweep = 0; sweep < 4; ++sweep) respond();
    VelocityUpdate{garment.particle_count, position.view(), predicted.view(), inverse_mass.data(), kDt, velocity.view()}
        .run();
    ContactVelocity{contacts(), kDt, velocity.view()}.run();
  }
  Vec3 sum(ConstVec3View of) const {
    Vec3 total;
    for (std::uint32_t i = 0; i < garment.particle_count; ++i) {
      if (inverse_mass[i] > 0.0f) total += of[i] * (1.0f / inverse_mass[i]);
    }
    return total;
  }
};

/// A face in the plane y = 0, and another one whose first corner, particle 3, is at `tip`.
SelfCloth face_and_tip(const Vec3& tip, const std::vector<std::uint32_t>& pins = {}) {
  return SelfCloth({{0, 0, 0}, {0, 0, 0.1f}, {0.1f, 0, 0}, tip, tip + Vec3{0.02f, 1, 0}, tip + Vec3{0, 1, 0.02f}},
                   {{0, 1, 2}, {3, 4, 5}}, pins);
}

TEST(SelfDetection, AThrownParticleNeverPassesAFace) {
  for (const float speed : {0.05f, 0.5f, 2.0f, 5.0f, 10.0f, 20.0f, 50.0f, 100.0f}) {
    for (const float side : {1.0f, -1.0f}) {
      for (const bool held : {false, true}) {
        SelfCloth cloth = face_and_tip({0.03f, 0.06f * side, 0.03f},
                                       held ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{});
        cloth.velocity.view().set(3, {0, -speed * side, 0});
        for (int step = 0; step < 1500; ++step) {
          cloth.substep();
          const Vec3 normal = cross(cloth.x(1) - cloth.x(0), cloth.x(2) - cloth.x(0));
          ASSERT_GT(dot(cloth.x(3) - cloth.x(0), normal) * side, 0.0f) << speed << " m/s, step " << step;
        }
      }
    }
  }
}

TEST(SelfDetection, PropertyRowsKeepMomentum) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> small(-0.002f, 0.002f);
  for (int trial = 0; trial < 200; ++trial) {
    SelfCloth cloth = face_and_tip({0.03f, 0.02f, 0.03f});
    cloth.put(3, {0.03f, 0.002f, 0.03f}, {0.03f, 0.002f, 0.03f});
    for (std::uint32_t i = 0; i < 6; ++i) {
      cloth.inverse_mass[i] = 500.0f + 100.0f * static_cast<float>(i);
      cloth.position.view().add(i, {small(random), small(random), small(random)});
    }
    cloth.detect();
    ASSERT_EQ(cloth.row_count, 1u);
    const Vec3 before = cloth.sum(cloth.position.view());
    cloth.respond();
    EXPECT_LT(length(cloth.sum(cloth.position.view()) - before), 1e-9f);
  }
}

TEST(SelfDetection, ContactEndsAtTheDistance) {
  SelfCloth cloth = face_and_tip({0.03f, 0.002f, 0.03f});
  for (int step = 0; step < 10; ++step) cloth.substep();
  const Vec3 normal = normalized_or(cross(cloth.x(1) - cloth.x(0), cloth.x(2) - cloth.x(0)), {});
  // At rest the tip is 2 mm from the face: half of that is what the pair keeps, and it has that already.
  EXPECT_NEAR(dot(cloth.x(3) - cloth.x(0), normal), 0.002f, 1e-6f);
  EXPECT_EQ(cloth.stats.self_contacts, 0u);
  cloth.put(3, {0.03f, 0.0004f, 0.03f}, {0.03f, 0.0004f, 0.03f});
  cloth.substep();
  const Vec3 tilted = normalized_or(cross(cloth.x(1) - cloth.x(0), cloth.x(2) - cloth.x(0)), {});
  EXPECT_NEAR(dot(cloth.x(3) - cloth.x(0), tilted), 0.001f, 1e-5f);
}

TEST(SelfDetection, WhatWasForcedThroughComesBack) {
  SelfCloth cloth = face_and_tip({0.03f, 0.012f, 0.03f}, {0, 1, 2});
  cloth.detect();  // remembers the side
  ASSERT_GT(cloth.pair_count, 0u);
  cloth.put(3, {0.03f, -0.008f, 0.03f}, {0.03f, -0.008f, 0.03f});
  for (int step = 0; step < 20; ++step) cloth.substep();
  EXPECT_NEAR(cloth.x(3).y, kDistance, 1e-4f);
}

TEST(SelfDetection, TheRestShapeMakesNoContact) {
  for (const float spacing : {0.1f, 0.01f, 0.002f}) {  // also where neighbours are nearer than the distance
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    constexpr std::uint32_t kSide = 8;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      const float u = static_cast<float>(i % kSide), v = static_cast<float>(i / kSide);
      positions.push_back({spacing * u, 0.3f * spacing * std::sin(2.0f * u), spacing * v});
      if (i % kSide + 1 == kSide || i / kSide + 1 == kSide) continue;
      triangles.push_back({i, i + kSide, i + 1});
      triangles.push_back({i + 1, i + kSide, i + kSide + 1});
    }
    SelfCloth cloth(positions, triangles);
    for (int step = 0; step < 3; ++step) cloth.substep();
    EXPECT_EQ(cloth.stats.self_contacts, 0u) << spacing;
    EXPECT_EQ(cloth.stats.contacts_dropped, 0u) << spacing;
  }
}

/// Two triangles that stand on each other's far side but for one edge of each: along z below, along x above.
SelfCloth crossed_edges(float height, const std::vector<std::uint32_t>& pins = {}) {
  return SelfCloth({{0, 0, -0.05f}, {0, 0, 0.05f}, {0, -1, 0}, {-0.05f, height, 0}, {0.05f, height, 0}, {0, 1, 0}},
                   {{0, 1, 2}, {3, 4, 5}}, pins);
}

TEST(SelfDetection, AThrownEdgeNeverPassesAnEdge) {
  for (const float speed : {0.05f, 0.5f, 2.0f, 5.0f, 10.0f, 20.0f, 50.0f}) {
    for (const bool held : {false, true}) {
      SelfCloth cloth = crossed_edges(0.06f, held ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{});
      for (const std::uint32_t i : {3u, 4u, 5u}) cloth.velocity.view().set(i, {0, -speed, 0});
      for (int step = 0; step < 300; ++step) {
        cloth.substep();
        const Vec3 u = cloth.x(1) - cloth.x(0), v = cloth.x(4) - cloth.x(3);
        const SegmentPair at = closest_between_segments(cloth.x(0), cloth.x(1), cloth.x(3), cloth.x(4));
        if (!(std::min({at.s, 1.0f - at.s, at.t, 1.0f - at.t}) > 0.0f)) break;  // past each other's ends, tumbling
        ASSERT_GT(dot(cloth.x(3) - cloth.x(0), cross(u, v)), 0.0f) << speed << " m/s, step " << step;
      }
    }
  }
}

TEST(SelfDetection, PropertyRowsOfEdgesKeepMomentum) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> small(-0.002f, 0.002f);
  for (int trial = 0; trial < 200; ++trial) {
    SelfCloth cloth = crossed_edges(0.02f);
    for (const std::uint32_t i : {3u, 4u}) cloth.put(i, cloth.x(i) - Vec3{0, 0.018f, 0}, cloth.x(i));
    for (std::uint32_t i = 0; i < 6; ++i) {
      cloth.inverse_mass[i] = 500.0f + 100.0f * static_cast<float>(i);
      cloth.position.view().add(i, {small(random), small(random), small(random)});
    }
    cloth.detect();
    ASSERT_EQ(cloth.row_count, 1u);
    const Vec3 before = cloth.sum(cloth.position.view());
    cloth.respond();
    EXPECT_EQ(cloth.stats.self_contacts, 1u);
    EXPECT_LT(length(cloth.sum(cloth.position.view()) - before), 1e-9f);
  }
}

TEST(SelfDetection, EdgesThatWereForcedThroughComeBack) {
  SelfCloth cloth = crossed_edges(0.012f, {0, 1, 2});
  cloth.detect();  // remembers the side
  for (const std::uint32_t i : {3u, 4u}) cloth.put(i, cloth.x(i) - Vec3{0, 0.02f, 0}, cloth.x(i) - Vec3{0, 0.02f, 0});
  for (int step = 0; step < 20; ++step) cloth.substep();
  EXPECT_NEAR(0.5f * (cloth.x(3).y + cloth.x(4).y), kDistance, 1e-4f);
}

/// Triangles that share no corner, anywhere in a box of .6 m.
SelfCloth loose_triangles(std::uint32_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-0.3f, 0.3f);
  std::vector<Vec3> positions(3 * count);
  for (Vec3& p : positions) p = {place(random), place(random), place(random)};
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 3 * count; i += 3) triangles.push_back({i, i + 1, i + 2});
  return SelfCloth(positions, triangles);
}

/// Moves each particle a little.
void drift(SelfCloth& cloth, std::mt19937& random) {
  std::uniform_real_distribution<float> step(-0.004f, 0.004f);
  for (std::uint32_t i = 0; i < cloth.garment.particle_count; ++i) {
    cloth.put(i, cloth.x(i) + Vec3{step(random), step(random), step(random)}, cloth.x(i));
  }
}

TEST(SelfCandidates, PropertyNothingNearOverAFaceIsMissed) {
  std::mt19937 random(7);
  SelfCloth cloth = loose_triangles(30, random);
  constexpr float kReach = 0.02f;
  int near = 0;
  for (int tick = 0; tick < 40; ++tick) {
    drift(cloth, random);
    const SelfCandidates search = cloth.candidates(kReach);
    search.run(cloth.stats);
    for (std::uint32_t f = 0; f < 30; ++f) {
      for (std::uint32_t p = 0; p < 90; ++p) {
        if (p / 3 == f) continue;
        const Vec3 a = cloth.x(3 * f), b = cloth.x(3 * f + 1), c = cloth.x(3 * f + 2);
        const Barycentrics at = closest_on_triangle(cloth.x(p), a, b, c);
        const bool over = at.a > 0.0f && at.b > 0.0f && at.c > 0.0f;
        if (!over || length(at.point(a, b, c) - cloth.x(p)) > kReach) continue;
        ++near;
        const auto* end = search.pairs.pairs + cloth.pair_count;
        EXPECT_TRUE(std::any_of(static_cast<const NearPair*>(search.pairs.pairs), end,
                                [&](const NearPair& pair) {
                                  return pair.kind == NearKind::kParticleFace && pair.first == p && pair.second == f;
                                }))
            << "particle " << p << ", face " << f << ", tick " << tick;
      }
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_EQ(cloth.stats.contacts_dropped, 0u);
}

TEST(SelfCandidates, PropertyNoNearEdgesAreMissed) {
  std::mt19937 random(8);
  SelfCloth cloth = loose_triangles(20, random);
  constexpr float kReach = 0.02f;
  int near = 0;
  for (int tick = 0; tick < 40; ++tick) {
    drift(cloth, random);
    const SelfCandidates search = cloth.candidates(kReach);
    search.run(cloth.stats);
    const auto& end = cloth.garment.edge_particle;
    for (std::uint32_t e = 0; e < cloth.garment.edge_count; ++e) {
      for (std::uint32_t o = 0; o < e; ++o) {
        const Vec3 p0 = cloth.x(end[0][o]), p1 = cloth.x(end[1][o]), q0 = cloth.x(end[0][e]), q1 = cloth.x(end[1][e]);
        const SegmentPair at = closest_between_segments(p0, p1, q0, q1);
        if (end[0][o] / 3 == end[0][e] / 3 || length(lerp(p0, p1, at.s) - lerp(q0, q1, at.t)) > kReach) continue;
        ++near;
        const NearPair* last = search.pairs.pairs + cloth.pair_count;
        EXPECT_TRUE(std::any_of(
            static_cast<const NearPair*>(search.pairs.pairs), last,
            [&](const NearPair& pair) { return pair.kind == NearKind::kEdges && pair.first == o && pair.second == e; }))
            << "edges " << o << ", " << e << ", tick " << tick;
      }
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_EQ(cloth.stats.contacts_dropped, 0u);
}

TEST(SelfCandidates, NothingIsSoughtWhileTheClothMovesAsAWhole) {
  SelfCloth cloth = face_and_tip({0.03f, 0.012f, 0.03f});
  cloth.detect();
  ASSERT_GT(cloth.pair_count, 0u);
  cloth.pairs[0].distance = 0.123f;  // a new search would set it right
  for (std::uint32_t i = 0; i < 6; ++i) cloth.put(i, cloth.x(i) + Vec3{5, 1, 0}, cloth.x(i));
  cloth.detect();
  EXPECT_EQ(cloth.pairs[0].distance, 0.123f);
}

TEST(SelfCandidates, PairsBeyondTheRoomAreCounted) {
  SelfCloth cloth = face_and_tip({0.03f, 0.012f, 0.03f});
  SelfCandidates search = cloth.candidates();
  search.pairs.capacity = 0;
  search.run(cloth.stats);
  EXPECT_EQ(cloth.pair_count, 0u);
  EXPECT_GT(cloth.stats.contacts_dropped, 0u);
}

}  // namespace
}  // namespace pleat::test
