#include "systems/disturbance.h"

#include <gtest/gtest.h>

#include "tests/systems/sheet.h"

namespace pleat {
namespace {

constexpr std::uint32_t kPins[] = {0};

struct DisturbanceTest : testing::Test {
  Sheet sheet{make_grid({.rows = 3, .columns = 3}), kPins};  // from -0.5 to 0.5 in x and z
  CapsuleColumns capsules{std::pmr::new_delete_resource()};
  Vec3Column pin_from{std::pmr::new_delete_resource()}, pin_to{std::pmr::new_delete_resource()};

  DisturbanceTest() {
    pin_from.resize(1), pin_to.resize(1);
    for (Vec3Column* column : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
      column->resize(1);
      column->view().set(0, {2, 0, 0});
    }
    for (Column<float>* column : {&capsules.radius, &capsules.taper, &capsules.thickness}) column->resize(1);
    capsules.radius[0] = 0.1f;
    capsules.enabled.resize(1), capsules.groups.push_back(kFirstGroup);
    capsules.enabled[0] = 1;
  }
  Disturbance around() {
    return {.garment = &sheet.garment,
            .position = sheet.position,
            .pin_previous = pin_from.view(),
            .pin_next = pin_to.view(),
            .bodies = {.capsules = &capsules},
            .reach = 0.05f};
  }
  bool after_move_to(float x) {
    capsules.next_a.view().set(0, {x, 0, 0});
    return around().run();
  }
};

TEST_F(DisturbanceTest, RefusesToRunWithAFieldMissing) {
  ASSERT_TRUE(around().validate());
  Disturbance bad = around();
  bad.garment = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = around(), bad.position = {};
  EXPECT_FALSE(bad.validate());
  bad = around(), bad.pin_next = {};
  EXPECT_FALSE(bad.validate());
  bad = around(), bad.bodies.capsules = nullptr;
  EXPECT_FALSE(bad.validate());
  bad = around(), bad.reach = kNan;
  EXPECT_FALSE(bad.validate());
}

TEST_F(DisturbanceTest, PinsThatMoveAtAllCount) {
  EXPECT_FALSE(around().run());
  pin_to.view().set(0, {0, 0, 1e-6f});
  EXPECT_TRUE(around().run());
}

TEST_F(DisturbanceTest, BodiesCountWhereTheirWayComesNear) {
  EXPECT_FALSE(after_move_to(0.66f));
  EXPECT_TRUE(after_move_to(0.64f));
  EXPECT_TRUE(after_move_to(-2.0f)) << "through it within the tick";
  capsules.enabled[0] = 0;
  EXPECT_FALSE(around().run());
  capsules.enabled[0] = 1;
  for (Vec3Column* column : {&capsules.previous_a, &capsules.previous_b, &capsules.next_a, &capsules.next_b}) {
    column->view().set(0, {});
  }
  EXPECT_FALSE(around().run()) << "it rests on it";
}

TEST_F(DisturbanceTest, MeshesAndPlanesToo) {
  MeshCollider mesh(std::pmr::new_delete_resource());
  mesh.previous.resize(1), mesh.next.resize(1);
  const MeshCollider* meshes[] = {&mesh};
  PlaneCollider plane;
  Disturbance d = around();
  d.bodies.meshes = meshes, d.bodies.planes = {&plane, 1};
  EXPECT_FALSE(d.run());
  mesh.next.view().set(0, {0, 3, 0});
  EXPECT_TRUE(d.run());
  mesh.previous.view().set(0, {0, 2, 0});
  EXPECT_FALSE(d.run());
  mesh.thickness = 1.96f;
  EXPECT_TRUE(d.run());
  mesh.thickness = 0.0f, mesh.bow = 1.96f;
  EXPECT_TRUE(d.run());
  mesh.enabled = false;
  EXPECT_FALSE(d.run());
  plane.next.position = {0, -1, 0};
  EXPECT_TRUE(d.run());
}

TEST_F(DisturbanceTest, TheLargestSpeedIsThatOfTheFastestParticle) {
  EXPECT_EQ(largest_speed(sheet.count, sheet.velocity), 0.0f);
  sheet.velocity.set(3, {0, 3, -4}), sheet.velocity.set(5, {1, 1, 1});
  EXPECT_EQ(largest_speed(sheet.count, sheet.velocity), 5.0f);
}

}  // namespace
}  // namespace pleat
