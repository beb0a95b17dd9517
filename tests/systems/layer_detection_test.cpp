#include "systems/layer_detection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "systems/box.h"
#include "systems/closest_points.h"
#include "systems/collision_response.h"
#include "systems/layer_candidates.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kDistance = 0.005f, kDt = 0.002f;

/// A cloth over another one, which moves from where it was built by `step` in a tick.
struct Layered {
  ContactCloth own, below;
  Vec3Column begin{memory()}, end{memory()}, sought_at{memory()};
  std::vector<NearPair> pairs = std::vector<NearPair>(512);
  std::uint32_t pair_count = kNone, room = 512;
  LayersSought sought;
  LayersAround around;
  NearScratch scratch{memory()};
  LayerCloth clothes[2];
  std::span<const LayerCloth> all = clothes;
  Stats stats;

  Layered(ContactCloth upper, ContactCloth lower, const Vec3& step) : own(std::move(upper)), below(std::move(lower)) {
    const std::uint32_t count = below.garment.particle_count;
    begin.resize(count), end.resize(count), sought_at.resize(own.garment.particle_count);
    copy(end.view(), below.position.view(), count);
    next_tick([&](std::uint32_t) { return step; });
    scratch.pairs.resize(512), scratch.make_room(64, 64);
  }
  /// The cloth below goes on from where it is: particle i by step(i).
  template <class Step>
  void next_tick(const Step& step) {
    Box box;
    for (std::uint32_t i = 0; i < below.garment.particle_count; ++i) {
      const Vec3 from = end.view()[i], to = from + step(i);
      begin.view().set(i, from), end.view().set(i, to);
      box.include(from), box.include(to);
    }
    clothes[1] = {.garment = &below.garment,
                  .layer = 1,
                  .begin = std::as_const(begin).view(),
                  .end = std::as_const(end).view(),
                  .low = box.low,
                  .high = box.high};
  }
  NearPairList list() { return {pairs.data(), room, &pair_count}; }
  void search(float t0, float t1) {
    if (t0 == 0.0f) around = {};
    const LayerCandidates search{.garment = &own.garment,
                                 .position = own.position.view(),
                                 .previous = own.previous.view(),
                                 .layer = 2,
                                 .clothes = all,
                                 .t0 = t0,
                                 .t1 = t1,
                                 .distance = kDistance,
                                 .pairs = list(),
                                 .sought_at = sought_at.view(),
                                 .sought = &sought,
                                 .around = &around,
                                 .scratch = &scratch};
    ASSERT_TRUE(search.validate());
    search.run(stats);
  }
  void detect(float t0, float t1) {
    own.row_count = 0;
    const LayerDetection detection{.garment = &own.garment,
                                   .position = own.packed_position(),
                                   .begin = own.packed_previous(),
                                   .previous = own.previous.view(),
                                   .inverse_mass = own.inverse_mass.data(),
                                   .clothes = clothes,
                                   .t0 = t0,
                                   .t1 = t1,
                                   .pairs = list(),
                                   .friction = 0.3f,
                                   .dt = kDt,
                                   .scratch = &scratch,
                                   .contacts = own.contacts()};
    ASSERT_TRUE(detection.validate());
    detection.run(stats);
  }
  void substep(float t0, float t1) {
    search(t0, t1);
    detect(t0, t1);
    for (int sweep = 0; sweep < 10; ++sweep) own.run(CollisionResponse{.contacts = own.contacts()}, stats);
  }
  /// Of the pairs with one of the cloths, those whose side is known.
  std::size_t sides(std::uint32_t cloth) const {
    return static_cast<std::size_t>(std::count_if(pairs.begin(), pairs.begin() + pair_count, [&](const NearPair& p) {
      return p.cloth == cloth && p.side != 0.0f;
    }));
  }
  /// Whether pairs are sought: those that there were are lost.
  bool seeks(float t0, float t1) {
    pair_count = 0;
    search(t0, t1);
    return pair_count != 0;
  }
  bool has(NearKind kind, std::uint32_t first, std::uint32_t second) const {
    return std::any_of(pairs.begin(), pairs.begin() + pair_count,
                       [&](const NearPair& p) { return p.kind == kind && p.first == first && p.second == second; });
  }
  /// Everything of the cloth as much further on.
  void move(const Vec3& step) {
    for (std::uint32_t i = 0; i < own.garment.particle_count; ++i) own.put(i, own.x(i) + step, own.x(i));
  }
};

const std::vector<Vec3> kFloor = {{-0.1f, 0, -0.1f}, {-0.1f, 0, 0.2f}, {0.2f, 0, -0.1f}};
const std::vector<Vec3> kTip = {{0, 0.012f, 0}, {0.05f, 0.3f, 0}, {0, 0.3f, 0.05f}};

std::vector<Vec3> roof() {
  std::vector<Vec3> roof = kFloor;
  for (Vec3& p : roof) p.y = 0.012f;
  return roof;
}

TEST(LayerDetection, AParticleIsCarriedByTheFaceBelow) {
  Layered scene(ContactCloth(kTip, {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {0.01f, 0.02f, 0});
  for (int s = 0; s < 8; ++s) {
    for (std::uint32_t i = 0; i < 3; ++i) scene.own.put(i, scene.own.x(i), scene.own.x(i));
    scene.substep(static_cast<float>(s) / 8, static_cast<float>(s + 1) / 8);
  }
  EXPECT_NEAR(scene.own.x(0).y, 0.02f + kDistance, 1e-5f);
  ASSERT_EQ(scene.own.row_count, 1u);
  const ContactRow& row = scene.own.rows[0];
  EXPECT_TRUE(row.at_particle());
  EXPECT_NEAR(row.normal.y, 1.0f, 1e-6f);
  EXPECT_NEAR(row.body_step.x, 0.01f / 8, 1e-7f);
  EXPECT_NEAR(row.body_step.y, 0.02f / 8, 1e-7f);
}

TEST(LayerDetection, AFaceRestsOnAParticleBelow) {
  std::vector<Vec3> tip = kTip;
  for (Vec3& p : tip) p.y = -p.y + 0.012f;  // its tip is at 0, the rest hangs down
  Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(tip, {{0, 1, 2}}), {0, 0.03f, 0});
  for (int s = 0; s < 8; ++s) {
    for (std::uint32_t i = 0; i < 3; ++i) scene.own.put(i, scene.own.x(i), scene.own.x(i));
    scene.substep(static_cast<float>(s) / 8, static_cast<float>(s + 1) / 8);
  }
  // The plane of the roof passes kDistance over the tip, measured along its normal.
  const Vec3 normal = normalized_or(cross(scene.own.x(1) - scene.own.x(0), scene.own.x(2) - scene.own.x(0)), {});
  EXPECT_NEAR(dot(scene.own.x(0) - Vec3{0, 0.03f, 0}, normal), kDistance, 2e-5f);
  ASSERT_EQ(scene.own.row_count, 1u);
  EXPECT_EQ(scene.own.rows[0].count, 3u);
}

TEST(LayerDetection, EdgesCarryEdges) {
  Layered scene(ContactCloth({{-0.05f, 0.012f, 0}, {0.05f, 0.012f, 0}, {0, 1, 0}}, {{0, 1, 2}}),
                ContactCloth({{0, 0, -0.05f}, {0, 0, 0.05f}, {0, -1, 0}}, {{0, 1, 2}}), {0, 0.03f, 0});
  for (int s = 0; s < 8; ++s) {
    for (std::uint32_t i = 0; i < 3; ++i) scene.own.put(i, scene.own.x(i), scene.own.x(i));
    scene.substep(static_cast<float>(s) / 8, static_cast<float>(s + 1) / 8);
  }
  EXPECT_NEAR(0.5f * (scene.own.x(0).y + scene.own.x(1).y), 0.03f + kDistance, 1e-5f);
  ASSERT_EQ(scene.own.row_count, 1u);
  EXPECT_EQ(scene.own.rows[0].count, 2u);
  EXPECT_FALSE(scene.own.rows[0].at_particle());
}

TEST(LayerCandidates, SidesOfEachClothBelowAreRemembered) {
  for (const bool first_goes : {false, true}) {
    Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {});
    scene.clothes[0] = scene.clothes[1];  // two that lie in the same place
    scene.search(0.0f, 1.0f);
    scene.detect(0.0f, 1.0f);
    const std::size_t known = scene.sides(1);
    ASSERT_GT(known, 0u);
    ASSERT_EQ(scene.sides(0), known);
    if (first_goes) scene.clothes[0] = {};
    scene.search(0.0f, 1.0f);
    EXPECT_EQ(scene.sides(0), first_goes ? 0 : known);
    EXPECT_EQ(scene.sides(1), known) << first_goes;
  }
}

TEST(LayerCandidates, PairsAreSoughtAnewWhereTheClothsMovedAgainstEachOther) {
  const ContactCloth floor(kFloor, {{0, 1, 2}});
  const float margin = 0.15f * floor.garment.mean_edge_length;
  struct Case {
    float own, below;  // how far each moves in half a tick, in margins
    bool anew;
  };
  for (const auto& [own, below, anew] : {Case{0.0f, 0.0f, false}, Case{0.9f, 0.0f, false}, Case{1.1f, 0.0f, true},
                                         Case{0.0f, 0.9f, false}, Case{0.0f, 1.1f, true}, Case{3.0f, 3.0f, false}}) {
    Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {2.0f * below * margin, 0, 0});
    scene.search(0.0f, 0.5f);
    scene.move({own * margin, 0, 0});
    EXPECT_EQ(scene.seeks(0.5f, 1.0f), anew) << own << " " << below;
  }
}

TEST(LayerCandidates, WhatMovesSlowlyIsAddedUpOverTicks) {
  const ContactCloth floor(kFloor, {{0, 1, 2}});
  const float margin = 0.15f * floor.garment.mean_edge_length;
  struct Case {
    float own, below;  // how far each moves in a tick, in margins
    int tick;          // in which pairs are sought anew; 0: in none
  };
  for (const auto& [own, below, expected] : {Case{0.0f, 0.0f, 0}, Case{0.0f, 0.19f, 6}, Case{0.19f, 0.0f, 6},
                                             Case{0.19f, 0.19f, 0}, Case{-0.19f, 0.19f, 3}}) {
    Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {});
    scene.search(0.0f, 1.0f);
    int found = 0;
    for (int tick = 1; tick <= 20 && found == 0; ++tick) {
      scene.next_tick([&, step = below * margin](std::uint32_t) { return Vec3{step, 0, 0}; });
      for (const float t0 : {0.0f, 0.5f}) {
        scene.move({0.5f * own * margin, 0, 0});
        if (scene.seeks(t0, t0 + 0.5f)) found = tick;
      }
    }
    EXPECT_EQ(found, expected) << own << " " << below;
  }
}

TEST(LayerCandidates, AClothThatIsNewNearbyOrWasForgottenIsSought) {
  Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {});
  scene.search(0.0f, 1.0f);
  EXPECT_FALSE(scene.seeks(0.0f, 1.0f));
  scene.clothes[0] = scene.clothes[1];
  EXPECT_TRUE(scene.seeks(0.0f, 1.0f));
  EXPECT_FALSE(scene.seeks(0.0f, 1.0f));
  scene.sought.near.remove(1);
  EXPECT_TRUE(scene.seeks(0.0f, 1.0f));
  scene.clothes[0] = {};
  EXPECT_TRUE(scene.seeks(0.0f, 1.0f));
  EXPECT_FALSE(scene.seeks(0.0f, 1.0f));
}

TEST(LayerCandidates, WherePairsFoundNoRoomTheyAreSoughtOnceATick) {
  Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {});
  scene.search(0.0f, 0.5f);
  const std::uint32_t all = scene.pair_count;
  ASSERT_GT(all, 4u);
  EXPECT_FALSE(scene.sought.cut);
  scene.room = all - 3, scene.pair_count = kNone;
  for (std::uint64_t tick = 1; tick <= 3; ++tick) {
    scene.search(0.0f, 0.5f);
    scene.search(0.5f, 1.0f);
    EXPECT_EQ(scene.pair_count, all - 3);
    EXPECT_EQ(scene.stats.contacts_dropped, 3 * tick);
    EXPECT_TRUE(scene.sought.cut);
  }
  scene.room = all;
  scene.search(0.0f, 0.5f);
  EXPECT_EQ(scene.pair_count, all);
  EXPECT_FALSE(scene.sought.cut);
  EXPECT_FALSE(scene.seeks(0.0f, 0.5f));
}

TEST(LayerCandidates, WhereManyAreNearPairsAreSoughtOnceATickAndWhereOneMoves) {
  const ContactCloth floor(kFloor, {{0, 1, 2}});
  const float margin = 0.15f * floor.garment.mean_edge_length;
  for (const float step : {0.0f, 0.9f, 1.1f}) {  // of the last one below in half a tick, in margins
    Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {2.0f * step * margin, 0, 0});
    LayerCloth stands = scene.clothes[1];
    stands.end = stands.begin;
    std::vector<LayerCloth> many(LayersNear::kMost + 2, stands);
    many.back() = scene.clothes[1];
    scene.all = many;
    for (int tick = 0; tick < 3; ++tick) {
      EXPECT_TRUE(scene.seeks(0.0f, 0.5f)) << tick;
      EXPECT_TRUE(scene.sought.near.too_many());
      EXPECT_EQ(scene.seeks(0.5f, 1.0f), step > 1.0f) << step << " " << tick;
    }
  }
}

TEST(LayersNear, AreKeptInOrderOrAreTooMany) {
  LayersNear near, same;
  for (std::uint32_t k = 0; k < LayersNear::kMost; ++k) near.add(2 * k), same.add(2 * k);
  EXPECT_TRUE(near == same);
  near.remove(3);
  EXPECT_TRUE(near == same);
  near.remove(4);
  EXPECT_FALSE(near == same);
  EXPECT_EQ(near.kept().size(), LayersNear::kMost - 1);
  EXPECT_EQ(near.kept()[2], 6u);
  same.add(99);
  EXPECT_TRUE(same.too_many());
  EXPECT_EQ(same.kept().size(), LayersNear::kMost);
  same.remove(1234);
  EXPECT_TRUE(same == LayersNear{});
}

/// Triangles with corners anywhere in a small box.
ContactCloth loose_triangles(std::uint32_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-0.1f, 0.1f), aside(-0.05f, 0.05f);
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;
  for (std::uint32_t f = 0; f < count; ++f) {
    const Vec3 at{place(random), place(random), place(random)};
    for (int k = 0; k < 3; ++k) x.push_back(at + Vec3{aside(random), aside(random), aside(random)});
    triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return ContactCloth(x, triangles);
}

TEST(LayerCandidates, PropertyNothingNearIsMissedOverManyTicks) {
  std::mt19937 random(11);
  constexpr std::uint32_t kFaces = 12;
  std::uniform_real_distribution<float> step(-0.0006f, 0.0006f);
  const auto drift = [&](std::uint32_t) { return Vec3{step(random) + 0.002f, step(random), step(random)}; };
  Layered scene(loose_triangles(kFaces, random), loose_triangles(kFaces, random), {});
  int near = 0, searches = 0;
  for (int tick = 0; tick < 150; ++tick) {
    scene.next_tick(drift);
    for (int s = 0; s < 3; ++s) {
      for (std::uint32_t i = 0; i < 3 * kFaces; ++i)
        scene.own.put(i, scene.own.x(i) + drift(i) * 0.33f, scene.own.x(i));
      const float t1 = static_cast<float>(s + 1) / 3;
      scene.search(static_cast<float>(s) / 3, t1);
      searches += scene.sought.t == t1 && scene.sought.others == 0.0f ? 1 : 0;
      const auto below = [&](std::uint32_t i) { return scene.clothes[1].at(i, t1, {}); };
      for (std::uint32_t f = 0; f < kFaces; ++f) {
        for (std::uint32_t p = 0; p < 3 * kFaces; ++p) {
          const Vec3 x = scene.own.x(p), a = below(3 * f), b = below(3 * f + 1), c = below(3 * f + 2);
          const Barycentrics at = closest_on_triangle(x, a, b, c);
          if (at.zeros() != 0 || length(at.point(a, b, c) - x) > 2.0f * kDistance) continue;
          ++near;
          EXPECT_TRUE(scene.has(NearKind::kParticleFace, p, f)) << tick << " " << p << " " << f;
        }
      }
      const auto &own_end = scene.own.garment.edge_particle, &end = scene.below.garment.edge_particle;
      for (std::uint32_t o = 0; o < scene.own.garment.edge_count; ++o) {
        for (std::uint32_t e = 0; e < scene.below.garment.edge_count; ++e) {
          const Vec3 p0 = scene.own.x(own_end[0][o]), p1 = scene.own.x(own_end[1][o]), q0 = below(end[0][e]),
                     q1 = below(end[1][e]);
          const SegmentPair at = closest_between_segments(p0, p1, q0, q1);
          if (length(lerp(p0, p1, at.s) - lerp(q0, q1, at.t)) > 2.0f * kDistance) continue;
          ++near;
          EXPECT_TRUE(scene.has(NearKind::kEdges, o, e)) << tick << " " << o << " " << e;
        }
      }
    }
  }
  EXPECT_GT(near, 1000);
  EXPECT_GT(searches, 3);
  EXPECT_LT(searches, 150);
  EXPECT_EQ(scene.stats.contacts_dropped, 0u);
}

TEST(LayerCandidates, AClothThatCameFromFarMeetsWhatIsThere) {
  Layered scene(ContactCloth(roof(), {{0, 1, 2}}), ContactCloth(kFloor, {{0, 1, 2}}), {});
  scene.move({0, 1, 0}), scene.move({});
  scene.search(0.0f, 0.5f);
  EXPECT_EQ(scene.pair_count, 0u);
  scene.move({0, -1, 0});
  scene.search(0.5f, 1.0f);
  EXPECT_GT(scene.pair_count, 0u);
}

TEST(NearScratch, MustHaveRoomForEachClothThatIsSeen) {
  const ContactCloth floor(kFloor, {{0, 1, 2}});
  const LayerCloth clothes[2] = {{}, {.garment = &floor.garment, .layer = 1}};
  NearScratch scratch(memory());
  EXPECT_FALSE(holds_all(scratch, clothes));
  scratch.make_room(3, 3);
  EXPECT_TRUE(holds_all(scratch, clothes));
  scratch.other_begin.resize(2);
  EXPECT_FALSE(holds_all(scratch, clothes));
}

TEST(LayerDetection, WithoutAreaThereIsNoRowAndNothingNotFinite) {
  ContactCloth lower(kFloor, {{0, 1, 2}});
  for (std::uint32_t i = 0; i < 3; ++i) lower.put(i, {}, {});
  ContactCloth upper(kTip, {{0, 1, 2}});
  for (std::uint32_t i = 0; i < 3; ++i) upper.put(i, {}, {});
  Layered scene(std::move(upper), std::move(lower), {});
  scene.substep(0.0f, 1.0f);
  EXPECT_EQ(scene.own.row_count, 0u);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_TRUE(is_finite(scene.own.x(i)));
}

}  // namespace
}  // namespace pleat::test
