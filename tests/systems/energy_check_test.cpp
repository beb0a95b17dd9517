#include "systems/energy_check.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr std::uint32_t kPins[] = {0};
constexpr float kAny = 10.0f;  // m/s, allowed to all

struct EnergyCheckTest : testing::Test {
  Sheet sheet{make_grid({.rows = 3, .columns = 3}), kPins};
  CapsuleColumns capsules{std::pmr::new_delete_resource()};
  Vec3Column pin_from{std::pmr::new_delete_resource()}, pin_to{std::pmr::new_delete_resource()};

  EnergyCheckTest() { pin_from.resize(1), pin_to.resize(1); }
  SpeedBound bound() {
    return {.garment = &sheet.garment,
            .start = sheet.position,
            .mass = sheet.mass,
            .inverse_mass = sheet.inverse_mass,
            .pin_previous = pin_from.view(),
            .pin_next = pin_to.view(),
            .bodies = {.capsules = &capsules},
            .room = 1e6f,
            .dt = 0.02f,
            .substep = 0.002f};
  }
};

TEST_F(EnergyCheckTest, RefusesToRunWithAFieldMissing) {
  ASSERT_TRUE(bound().validate());
  SpeedBound bad = bound();
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = bound(), bad.start = {};
  EXPECT_FALSE(bad.validate());
  bad = bound(), bad.mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = bound(), bad.inverse_mass = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = bound(), bad.pin_next = {};
  EXPECT_FALSE(bad.validate());
  bad = bound(), bad.bodies.capsules = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = bound(), bad.substep = 0.0f;
  EXPECT_FALSE(bad.validate());
  bad = bound(), bad.start_speed = kNan;
  EXPECT_FALSE(bad.validate());
}

TEST_F(EnergyCheckTest, SpeedIsWeightedByMassAndLeavesPinsOut) {
  const auto speed = [&] { return rms_speed(sheet.count, sheet.mass, sheet.inverse_mass, sheet.velocity); };
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.velocity.set(i, {3, 0, 4});
  sheet.velocity.set(0, {1000, 0, 0});  // the pin
  EXPECT_FLOAT_EQ(speed(), 5.0f);
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.velocity.set(i, {});
  sheet.velocity.set(4, {2, 0, 0});
  float moving = 0.0f;
  for (std::uint32_t i = 1; i < sheet.count; ++i) moving += sheet.mass[i];
  EXPECT_FLOAT_EQ(speed(), 2.0f * std::sqrt(sheet.mass[4] / moving));
  sheet.velocity.set(4, {kNan, 0, 0});
  EXPECT_FALSE(std::isfinite(speed()));
}

TEST_F(EnergyCheckTest, EachSourceAddsTwiceTheSpeedThatItCanGive) {
  EXPECT_FLOAT_EQ(bound().run(), kAny);
  SpeedBound b = bound();
  b.start_speed = 3.0f;
  EXPECT_FLOAT_EQ(b.run(), kAny + 6.0f);
  b = bound(), b.gravity = 10.0f;
  EXPECT_FLOAT_EQ(b.run(), kAny + 0.4f);
  EXPECT_FLOAT_EQ(b.least(), kAny + 0.4f);
  b = bound(), b.wind = 20.0f;
  EXPECT_FLOAT_EQ(b.run(), kAny + 40.0f);
  pin_to.view().set(0, {0, 0.1f, 0});  // 5 m/s
  EXPECT_FLOAT_EQ(bound().run(), kAny + 10.0f);
  pin_to.view().set(0, {});
  for (Vec3Column* column : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
    column->resize(1);
  }
  capsules.enabled.push_back(1), capsules.groups.push_back(kFirstGroup);
  capsules.next_b.view().set(0, {0.3f, 0, 0.4f});  // 25 m/s
  EXPECT_FLOAT_EQ(bound().run(), kAny + 50.0f);
  PlaneCollider plane;
  plane.next.position = {0, 0.6f, 0};  // 30 m/s
  b = bound(), b.bodies.planes = {&plane, 1};
  EXPECT_FLOAT_EQ(b.run(), kAny + 60.0f);
  MeshCollider mesh(std::pmr::new_delete_resource());
  mesh.previous.resize(2), mesh.next.resize(2);
  mesh.next.view().set(1, {0.7f, 0, 0}), mesh.bow = 0.1f;  // 40 m/s
  const MeshCollider* meshes[] = {&mesh};
  b.bodies.meshes = meshes;
  EXPECT_FLOAT_EQ(b.run(), kAny + 80.0f);
  b.bodies.collides_with = ~kFirstGroup;
  EXPECT_FLOAT_EQ(b.run(), kAny);
}

TEST_F(EnergyCheckTest, AllHingesMayHaveBeenBentByHalfATurn) {
  SpeedBound b = bound();
  b.bend_stiffness = 0.5f;
  const Garment& g = sheet.garment;
  float twice_energy = 0.0f, moving = 0.0f;
  for (std::uint32_t h = 0; h < g.hinge_count; ++h) twice_energy += 0.5f * g.hinge_bound[h] * 9.8696044f;
  for (std::uint32_t i = 1; i < sheet.count; ++i) moving += sheet.mass[i];
  EXPECT_NEAR(b.run() - kAny, 2.0f * std::sqrt(twice_energy / moving), 1e-4f);
}

TEST_F(EnergyCheckTest, WhatIsTooFarFromItsPinIsExpectedToSnapBack) {
  sheet = Sheet(make_grid({.rows = 12, .columns = 12}), kPins);
  const float longest = std::ranges::max(sheet.garment.tether_length);
  ASSERT_GT(longest, 1.4f);  // m
  for (std::uint32_t i = 0; i < sheet.count; ++i) sheet.position.set(i, sheet.position[i] * 1.1f);
  EXPECT_NEAR(bound().run(), kAny + 2.0f * 0.1f * longest / 0.002f, 0.1f);
}

TEST_F(EnergyCheckTest, WhatIsStretchedIsExpectedToSnapBack) {
  sheet.position.set(8, sheet.position[8] + Vec3{0.25f, 0, 0});
  EXPECT_NEAR(bound().run(), kAny + 2.0f * 0.25f / 0.002f, 1.0f) << "by the strain limit";
  SpeedBound springs = bound();
  springs.substep = 1e9f;
  springs.stiffness = 1e3f;
  const float soft = springs.run() - kAny;
  EXPECT_GT(soft, 10.0f) << "by its springs";
  springs.room = 1.0f;  // of which a step carries little
  EXPECT_LT(springs.run() - kAny, soft / 10.0f);
}

}  // namespace
}  // namespace pleat
