#include "systems/capsule_candidates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "components/shapes.h"
#include "systems/capsule_detection.h"
#include "systems/closest_points.h"
#include "tests/systems/contact_scene.h"

namespace pleat::test {
namespace {

constexpr float kThickness = 0.005f, kDt = 0.002f;

/// A skirt around two legs that swing, in substeps; cloth and legs travel together.
struct Walk {
  Mesh mesh;
  ContactCloth cloth{mesh.positions, mesh.triangles};
  std::vector<CapsulePose> capsules;
  std::vector<std::uint64_t> all;
  Vec3 velocity{0, 0, 0};  // of everything, m/s
  float swing = 0.0f;      // of the legs' ends, m/s
  float tremble = 0.0f;    // of each particle, m a substep
  int steps = 0;
  std::mt19937 random{3};

  explicit Walk(
      const std::vector<Ring>& rings = {{11, 0.15f, 0.0f}, {11, 0.2f, -0.12f}, {11, 0.24f, -0.24f}, {11, 0.3f, -0.4f}})
      : mesh(make_rings(rings)) {
    for (const float x : {-0.09f, 0.09f, 3.0f}) {
      capsules.push_back({.a = {x, 0, 0}, .b = {x, -0.42f, 0}, .step_a = {}, .step_b = {}, .radius = 0.08f});
      capsules.back().index = static_cast<std::uint32_t>(capsules.size());
    }
    capsules[1].taper = -0.03f;
    cloth.candidates.make_room(cloth.garment, capsules.size());
    cloth.blocks.resize(capsule_blocks(capsules.size()));
  }
  void step() {
    std::uniform_real_distribution<float> any(-tremble, tremble);
    const Vec3 carried = velocity * kDt;
    for (std::uint32_t i = 0; i < cloth.garment.particle_count; ++i) {
      const Vec3 x = cloth.x(i);
      cloth.put(i, x + carried + Vec3{any(random), any(random), any(random)}, x);
    }
    for (CapsulePose& c : capsules) {
      c.step_a = carried, c.step_b = carried + Vec3{0, 0, (c.a.x < 0.0f ? swing : -swing) * kDt};
      c.a += c.step_a, c.b += c.step_b;
    }
    ++steps;
  }
  CapsuleCandidates candidates() {
    return {&cloth.garment,
            cloth.position.view(),
            cloth.packed_position(),
            capsules.data(),
            static_cast<std::uint32_t>(capsules.size()),
            kThickness,
            cloth.margin(),
            &cloth.candidates};
  }
  std::vector<ContactRow> rows() {
    cloth.row_count = 0;
    Stats stats;
    CapsuleDetection{&cloth.garment,
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
                     cloth.blocks.data()}
        .run(stats);
    return {cloth.rows.begin(), cloth.rows.begin() + cloth.row_count};
  }
  bool same_as_without() {
    const std::vector<ContactRow> found = rows();
    const std::vector<NearFeatures> kept(cloth.candidates.near.begin(), cloth.candidates.near.end());
    list_everything(cloth.garment, static_cast<std::uint32_t>(capsules.size()), cloth.candidates);
    const std::vector<ContactRow> all_rows = rows();
    std::copy(kept.begin(), kept.end(), cloth.candidates.near.begin());
    row_count += all_rows.size();
    return found.size() == all_rows.size() &&
           std::memcmp(found.data(), all_rows.data(), found.size() * sizeof(ContactRow)) == 0;
  }
  bool was_just_made() const { return cloth.candidates.anchor.view()[0] == cloth.x(0); }
  std::size_t row_count = 0;
};

TEST(CapsuleCandidates, RowsAreTheSameAsWithoutThemWhateverMoves) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  int made = 0, kept = 0;
  std::size_t rows = 0;
  for (int n = 0; n < 40; ++n) {
    Walk walk;
    walk.velocity = Vec3{any(random), any(random), any(random)} * 5.0f;
    walk.swing = 4.0f * any(random);
    walk.tremble = 0.003f * (any(random) + 1.0f);
    for (int step = 0; step < 40; ++step) {
      walk.step();
      walk.candidates().run();
      ++(walk.was_just_made() ? made : kept);
      ASSERT_TRUE(walk.same_as_without()) << "walk " << n << ", step " << step;
    }
    rows += walk.row_count;
  }
  EXPECT_GT(made, 100);
  EXPECT_GT(kept, 500);
  EXPECT_GT(rows, 10000u);
}

/// Long edges with a corner far off that comes in, fast.
TEST(CapsuleCandidates, FarCornersComeNear) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1.0f, 1.0f);
  int made = 0, kept = 0;
  std::size_t rows = 0;
  for (int n = 0; n < 200; ++n) {
    Walk walk({{7, 0.16f, 0.0f}, {7, 0.3f, -0.2f}, {7, 0.45f, -0.35f}});
    walk.swing = 2.0f * any(random);
    std::vector<Vec3> way(walk.cloth.garment.particle_count);
    for (std::uint32_t i = 0; i < way.size(); ++i) {
      const Vec3 x = walk.cloth.x(i), inward = Vec3{-x.x, 0, -x.z} * (1.0f / std::hypot(x.x, x.z));
      way[i] = (inward * (1.0f + any(random)) + Vec3{any(random), any(random), any(random)}) *
               (0.012f * std::hypot(x.x, x.z));
    }
    for (int step = 0; step < 25; ++step) {
      for (std::uint32_t i = 0; i < way.size(); ++i) walk.cloth.put(i, walk.cloth.x(i) + way[i], walk.cloth.x(i));
      walk.step();
      walk.candidates().run();
      ++(walk.was_just_made() ? made : kept);
      ASSERT_TRUE(walk.same_as_without()) << "walk " << n << ", step " << step;
    }
    rows += walk.row_count;
  }
  EXPECT_GT(made, 500);
  EXPECT_GT(kept, 1000);
  EXPECT_GT(rows, 5000u);
}

TEST(CapsuleCandidates, WhatHasNoRoomIsLookedAtAsAWhole) {
  for (const std::size_t room : {0u, 8u, 40u}) {
    Walk walk;
    walk.cloth.candidates.corner.resize(room);
    walk.swing = 3.0f, walk.tremble = 0.002f;
    int whole = 0;
    for (int step = 0; step < 20; ++step) {
      walk.step();
      walk.candidates().run();
      ASSERT_TRUE(walk.same_as_without()) << "room " << room << ", step " << step;
      for (const NearFeatures& near : walk.cloth.candidates.near) whole += near.begin == NearFeatures::kAll;
    }
    EXPECT_GT(whole, 0) << room;
    EXPECT_GT(walk.row_count, 100u) << room;
  }
}

/// A leg that kicks, and the cloth with it.
TEST(CapsuleCandidates, WhatTurnsTogetherIsLookedForOnce) {
  Walk walk;
  walk.capsules.resize(1);
  const Vec3 hip = walk.capsules[0].a;
  const auto turned = [&](const Vec3& p) {
    constexpr float kAngle = 0.02f;  // a substep
    const Vec3 q = p - hip;
    return hip +
           Vec3{q.x, q.y * std::cos(kAngle) - q.z * std::sin(kAngle), q.y * std::sin(kAngle) + q.z * std::cos(kAngle)};
  };
  walk.step();
  walk.candidates().run();
  for (int step = 0; step < 60; ++step) {
    CapsulePose& leg = walk.capsules[0];
    leg.step_b = turned(leg.b) - leg.b, leg.b += leg.step_b;
    for (std::uint32_t i = 0; i < walk.cloth.garment.particle_count; ++i) {
      walk.cloth.put(i, turned(walk.cloth.x(i)), walk.cloth.x(i));
    }
    ++walk.steps;
    walk.candidates().run();
    ASSERT_FALSE(walk.was_just_made()) << step;
    ASSERT_TRUE(walk.same_as_without()) << step;
  }
}

TEST(CapsuleCandidates, WhatTravelsTogetherIsLookedForOnce) {
  Walk walk;
  walk.velocity = {8, 0, 3};
  for (int step = 0; step < 200; ++step) {
    walk.step();
    walk.candidates().run();
    ASSERT_EQ(walk.was_just_made(), step == 0) << step;
  }
}

TEST(CapsuleCandidates, AFarCapsuleHasNone) {
  Walk walk;
  walk.step();
  walk.candidates().run();
  const auto none = [&](std::uint32_t capsule) {
    return std::all_of(std::begin(kFeatureKinds), std::end(kFeatureKinds),
                       [&](FeatureKind kind) { return walk.cloth.candidates.of(capsule, kind).count == 0; });
  };
  EXPECT_FALSE(none(0));
  EXPECT_FALSE(none(1));
  EXPECT_TRUE(none(2));
}

TEST(CapsuleCandidates, OtherCapsulesAreLookedForAtOnce) {
  Walk walk;
  walk.step();
  walk.candidates().run();
  walk.step();
  walk.cloth.put(0, walk.cloth.x(0) + Vec3{1e-4f, 0, 0}, walk.cloth.x(0));
  walk.candidates().run();
  EXPECT_FALSE(walk.was_just_made());
  walk.capsules[2].index = 7;
  walk.candidates().run();
  EXPECT_TRUE(walk.was_just_made());
}

TEST(CapsuleCandidates, WhatWasFoundForOtherSizesOrGarmentsIsNotReliedOn) {
  Walk walk;
  walk.step();
  walk.candidates().run();
  const auto looks_anew = [&] {
    walk.cloth.put(0, walk.cloth.x(0) + Vec3{1e-4f, 0, 0}, walk.cloth.x(0));
    walk.candidates().run();
    return walk.was_just_made();
  };
  EXPECT_FALSE(looks_anew());
  walk.capsules[0].radius += 0.01f;
  EXPECT_TRUE(looks_anew());
  walk.capsules[1].taper = 0.01f;
  EXPECT_TRUE(looks_anew());
  EXPECT_FALSE(looks_anew());
  walk.cloth.candidates.thickness = 0.5f * kThickness;
  EXPECT_TRUE(looks_anew());
  walk.cloth.candidates.make_room(walk.cloth.garment, 3);
  EXPECT_TRUE(looks_anew());
}

TEST(CapsuleCandidates, WhatWasFoundWithAParticleThatWasNotFiniteIsNotReliedOn) {
  Walk walk;
  walk.step();
  const Vec3 x = walk.cloth.x(5);
  walk.cloth.put(5, {std::numeric_limits<float>::quiet_NaN(), x.y, x.z}, x);
  walk.candidates().run();
  walk.cloth.put(5, x, x);
  walk.cloth.put(0, walk.cloth.x(0) + Vec3{1e-4f, 0, 0}, walk.cloth.x(0));
  walk.candidates().run();
  EXPECT_TRUE(walk.was_just_made());
  EXPECT_TRUE(walk.same_as_without());
}

TEST(CapsuleCandidates, ValidateRefusesBrokenFields) {
  Walk walk;
  const CapsuleCandidates good = walk.candidates();
  EXPECT_TRUE(good.validate());
  CapsuleCandidates bad = good;
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = good;
  bad.capsule_count = 4;  // there is room for three
  EXPECT_FALSE(bad.validate());
  bad = good;
  bad.thickness = -1.0f;
  EXPECT_FALSE(bad.validate());
}

}  // namespace
}  // namespace pleat::test
